// Names of the units that a case is written in. Plastron computes with numbers, for which any units will do that fit together; texts and files call
// them m, N, J and Pa unless the case has names of its own.
#pragma once
#include <string>
#include <string_view>

namespace plastron::computation {

struct UnitNames {
  std::string length = "m";
  std::string force = "N";

  bool are_named() const { return length != "m" || force != "N"; }
  /// The name of a unit that is composed of m, N, J and Pa: "N/m^2" becomes "N/mm^2", and "Pa" the usual name of force / length^2, MPa for N and mm.
  std::string label(std::string_view unit) const;
  /// The text with the units after its numbers, and those in brackets, renamed: "moved by 2.5 m", "length [m]". Renaming twice changes nothing.
  std::string renamed(std::string_view text) const;
};

}  // namespace plastron::computation

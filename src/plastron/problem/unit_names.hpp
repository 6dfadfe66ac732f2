// Names of the units of a case. Plastron computes with numbers, in any consistent units. Texts and files name
// them m, N, J and Pa unless the case has its own names.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace plastron::problem {

struct UnitNames {
  std::string length = "m";
  std::string force = "N";
  bool are_stated = false;  ///< whether the case has [units], also with m and N

  bool are_named() const { return length != "m" || force != "N"; }
  /// Returns the SI value of force^force_power length^length_power, such as 1e6 for MPa; nothing for unknown names.
  std::optional<double> in_SI(int force_power, int length_power) const;
  /// Returns the name of a unit composed of m, N, J and Pa: "N/m^2" becomes "N/mm^2", and "Pa" the usual name of
  /// force / length^2, MPa for N and mm.
  std::string label(std::string_view unit) const;
  /// Returns the text with renamed units after its numbers and in brackets: "moved by 2.5 m", "length [m]". Renaming
  /// twice changes nothing.
  std::string renamed(std::string_view text) const;
};

}  // namespace plastron::problem

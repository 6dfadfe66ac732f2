// A statement that can be checked, what was measured, and what the measurement says about it.
#pragma once
#include <string>
#include <string_view>

namespace plastron::study {

enum class Verdict {
  holds,            ///< the measurement bears it out
  does_not_hold,    ///< the measurement speaks against it
  cannot_be_judged  ///< there is no measurement, or it is no more than rounding
};
/// In words: "holds", "does not hold", "cannot be judged".
std::string_view to_string(Verdict verdict);

struct Claim {
  std::string statement, measured;
  Verdict verdict = Verdict::cannot_be_judged;
  std::string reason{};  ///< why it cannot be judged; empty otherwise
};

Claim judged(std::string statement, std::string measured, bool holds);
Claim not_judged(std::string statement, std::string reason);

}  // namespace plastron::study

#include <research/study/claim.hpp>

#include <utility>

namespace plastron::study {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::does_not_hold:
      return "does not hold";
    case Verdict::cannot_be_judged:
      break;
  }
  return "cannot be judged";
}

Claim judged(std::string statement, std::string measured, bool holds) {
  return {.statement = std::move(statement),
          .measured = std::move(measured),
          .verdict = holds ? Verdict::holds : Verdict::does_not_hold};
}

Claim not_judged(std::string statement, std::string reason) {
  return {.statement = std::move(statement),
          .measured = "",
          .verdict = Verdict::cannot_be_judged,
          .reason = std::move(reason)};
}

}  // namespace plastron::study

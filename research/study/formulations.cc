#include <research/study/formulations.hpp>

#include <plastron/examination/examine.hpp>

#include <utility>

namespace plastron::study {

problem::Problem in_formulation(problem::Problem problem, element::Formulation formulation) {
  problem.shell.tangency.formulation = formulation;
  return problem;
}

std::string refusal(const problem::Problem& problem, element::Formulation formulation) {
  for (const examination::Finding& finding : examination::examine(in_formulation(problem, formulation)))
    if (finding.severity == examination::Severity::error) return finding.text;
  return "";
}

}  // namespace plastron::study

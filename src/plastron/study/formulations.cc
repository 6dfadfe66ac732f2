#include <plastron/study/formulations.hpp>

#include <plastron/study/examine.hpp>

#include <utility>

namespace plastron::study {

Problem in_formulation(Problem problem, assembly::Formulation formulation) {
  problem.discretisation.tangency.formulation = formulation;
  return problem;
}

std::string refusal(const Problem& problem, assembly::Formulation formulation) {
  for (const Finding& finding : examine(in_formulation(problem, formulation)))
    if (finding.severity == Severity::error) return finding.text;
  return "";
}

}  // namespace plastron::study

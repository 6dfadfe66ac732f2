// A problem in another formulation than its own, where the case allows it.
#pragma once
#include <plastron/problem/problem.hpp>

#include <string>

namespace plastron::study {

problem::Problem in_formulation(problem::Problem problem, element::Formulation formulation);

/// Why `run` would refuse the problem in this formulation; empty if it would not.
std::string refusal(const problem::Problem& problem, element::Formulation formulation);

}  // namespace plastron::study

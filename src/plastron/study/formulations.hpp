// A problem in another formulation than its own, where the case allows it.
#pragma once
#include <plastron/study/problem.hpp>

#include <string>

namespace plastron::study {

Problem in_formulation(Problem problem, assembly::Formulation formulation);

/// Why `run` would refuse the problem in this formulation; empty if it would not.
std::string refusal(const Problem& problem, assembly::Formulation formulation);

}  // namespace plastron::study

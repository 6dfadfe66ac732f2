// A problem in another formulation than its own, where the case allows it.
#pragma once
#include <plastron/computation/problem.hpp>

#include <string>

namespace plastron::study {

computation::Problem in_formulation(computation::Problem problem, element::Formulation formulation);

/// Why `run` would refuse the problem in this formulation; empty if it would not.
std::string refusal(const computation::Problem& problem, element::Formulation formulation);

}  // namespace plastron::study

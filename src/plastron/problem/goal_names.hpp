// The result quantities of a problem whose accuracy can be requested, by their names in results.json.
#pragma once
#include <plastron/estimation/functionals.hpp>
#include <plastron/problem/problem.hpp>

#include <string>
#include <vector>

namespace plastron::problem {

/// "energy", "reaction", "probe.NAME.u.z" and so on: see estimation::all_goals().
std::vector<std::string> goal_names(const Problem& problem);

/// Returns the goals of problem.accuracy, in their order. If several obstacles share a requested reaction, each
/// obstacle's own force follows. The reason: a sum of forces that cancel requires no accuracy. Precondition: names of
/// goal_names().
std::vector<estimation::Goal> estimated_goals(const Problem& problem);

}  // namespace plastron::problem

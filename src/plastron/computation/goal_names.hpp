// The numbers of a problem's results whose accuracy can be asked for, by the names that they have in results.json.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/estimation/goal_names.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// "energy", "reaction", "probe.NAME.u.z" and so on: see estimation::all_goals().
std::vector<std::string> goal_names(const Problem& problem);

/// The goals of problem.accuracy, in their order. Where several obstacles share a reaction that is asked for, each one's own force follows, for
/// the sum of forces that cancel asks for nothing. Precondition: names of goal_names().
std::vector<estimation::Goal> estimated_goals(const Problem& problem);

}  // namespace plastron::computation

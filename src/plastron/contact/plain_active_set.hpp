// The primal-dual active set iteration by itself, without a safeguard (primal_dual_active_set.hpp tells what it is): it ends with the
// solution, or says why it goes no further.
#pragma once
#include <plastron/contact/pressed_subproblem.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <optional>

namespace plastron::contact {

enum class PlainEnd {
  ended,        ///< the status of the solution says how: solved, iteration_limit or interrupted
  lost,         ///< a set came back, or the number of changes has not fallen for long
  no_minimiser  ///< the subproblem of the set that came up cannot be solved: PressedSubproblem::failure()
};

/// Iterates from `set`, whose point is given, as long as sets are new; `set` becomes the last one. Iterations are added to `solution` and
/// count towards the limit. (collective)
PlainEnd iterate_active_sets(const BoxProblem& problem, PressedSubproblem& subproblems,
                             std::optional<SubproblemPoint> point, const Settings& settings, const Observer& observer,
                             ActiveSet& set, BoxSolution& solution);

}  // namespace plastron::contact

// The primal-dual active set iteration without a safeguard (described in primal_dual_active_set.hpp). It ends with the
// solution, or with the reason why it stops.
#pragma once
#include <plastron/contact/pressed_subproblem.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <optional>

namespace plastron::contact {

enum class PlainEnd {
  ended,        ///< the status of the solution is solved, iteration_limit or interrupted
  lost,         ///< a set occurred again, or the number of changes has not decreased for many iterations
  no_minimiser  ///< the subproblem of the last set cannot be solved: PressedSubproblem::failure()
};

/// Iterates from `set`, whose point is given, as long as sets are new. `set` becomes the last one. Iterations are added
/// to `solution` and are part of the limit. (collective)
PlainEnd iterate_active_sets(const BoxProblem& problem, PressedSubproblem& subproblems,
                             std::optional<SubproblemPoint> point, const Settings& settings, const Observer& observer,
                             ActiveSet& set, BoxSolution& solution);

}  // namespace plastron::contact

// Steps of the primal-dual active set method without a safeguard: each solves on the subproblem of the present active
// set. Then it moves every unknown that violates a condition to the other set at once:
//   active   <-  free and beyond its bound
//   free     <-  active with a multiplier of the wrong sign
// It is a semismooth Newton method, fast near the solution's active set, but in general it may return to an earlier
// set. It remembers every set by its fingerprint, and stops there. Source: Hintermueller, Ito, Kunisch, The primal-dual
// active set strategy as a semismooth Newton method (2003).
//
// From a cold start the plain iteration makes far too many unknowns active in one step. Then it releases one row of
// nodes at the edge of the zone in each step. The number of steps is the number of excess rows, which doubles with
// every refinement. Among every 4^k-th bound only, the rows are 2^k times as far apart. The next finer thinning, with
// k - 1, starts from the active bounds of this one and the violated bounds between them. This is repeated until all
// bounds are used. Each thinning needs a few steps, so their number grows with the logarithm of the mesh size. Every
// step solves the whole problem with the same matrix, and needs no coarser mesh.
#pragma once
#include <plastron/contact/pressed_subproblem.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <optional>

namespace plastron::contact {

/// Starts from `set` with nothing active, whose point is given. `set` becomes the start for the iteration among all
/// bounds. Returns its point. Returns nothing if an intermediate set has no point; then `set` is unchanged. Iterations
/// are added to `solution`. Does nothing where few bounds are violated. (collective)
std::optional<SubproblemPoint> start_among_fewer(const BoxProblem& problem, PressedSubproblem& subproblems,
                                                 SubproblemPoint point, const Observer& observer, ActiveSet& set,
                                                 BoxSolution& solution);

enum class StepsEnd {
  ended,        ///< the status of the solution is solved, iteration_limit or interrupted
  lost,         ///< a set occurred again, or the number of changes has not decreased for many iterations
  no_minimiser  ///< the subproblem of the last set cannot be solved: PressedSubproblem::failure()
};

/// Iterates from `set`, whose point is given, as long as sets are new. `set` becomes the last one. Iterations are added
/// to `solution` and are part of the limit. (collective)
StepsEnd iterate_active_sets(const BoxProblem& problem, PressedSubproblem& subproblems,
                             std::optional<SubproblemPoint> point, const Settings& settings, const Observer& observer,
                             ActiveSet& set, BoxSolution& solution);

}  // namespace plastron::contact

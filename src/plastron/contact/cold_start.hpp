// A first active set from a cold start: the search uses few of the bounds first, then more.
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

namespace plastron::contact {

/// Starts from `set` with nothing active, whose point is given. `set` becomes the start for the iteration among all
/// bounds. Returns its point. Returns nothing if an intermediate set has no point; then `set` is unchanged. Iterations
/// are added to `solution`. Does nothing where few bounds are violated. (collective)
std::optional<SubproblemPoint> start_among_fewer(const BoxProblem& problem, PressedSubproblem& subproblems,
                                                 SubproblemPoint point, const Observer& observer, ActiveSet& set,
                                                 BoxSolution& solution);

}  // namespace plastron::contact

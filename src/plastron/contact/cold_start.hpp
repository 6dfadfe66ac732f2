// A first active set where nothing is known of it: found among few of the bounds, then among more.
//
// From a cold start the plain iteration takes in far too much at once and then gives the edge of the zone back a row of nodes a step: as
// many steps as the zone has rows too many, which double with every refinement. Among every 4^k-th bound only, the rows are 2^k times as far
// apart. What is active among those and what lies beyond its bound between them is where the next finer thinning begins, with k - 1, until
// all bounds count: a few steps each, so their number grows with the logarithm of the mesh. Every step is one of the whole problem, with
// the same matrix, and needs no coarser mesh.
#pragma once
#include <plastron/contact/pressed_subproblem.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

namespace plastron::contact {

/// From `set` with nothing active, whose point is given: `set` becomes the one to go on with among all bounds. Returns its point; nothing if a
/// set on the way has none, and then `set` is as it was. Iterations are added to `solution`. Does nothing where few bounds are broken. (collective)
std::optional<SubproblemPoint> start_among_fewer(const BoxProblem& problem, PressedSubproblem& subproblems,
                                                 SubproblemPoint point, const Observer& observer, ActiveSet& set,
                                                 BoxSolution& solution);

}  // namespace plastron::contact

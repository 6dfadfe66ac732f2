// Proximal points: they continue from a set that leaves a motion free, though more active bounds would fix it. From a
// centre z_k in the box
//   z_{k+1} = the minimiser of  J(z) + rho/2 (z - z_k)' D (z - z_k)  over the box,   D = diag A,
// It is a strictly convex program, which active sets solve with A + rho D in place of A. Then the ordinary method is
// tried from the set of z_{k+1}. If it meets a free motion again, rho decreases and z_{k+1} is the next centre.
// docs/methods/contact.md shows why the sets become the set of a solution, if there is one. Source: Rockafellar,
// Monotone operators and the proximal point algorithm (1976).
#pragma once
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/contact/subproblem.hpp>

namespace plastron::contact {

/// Continues with a box problem, without equations, from the set `so_far.activity`, on which `subproblems` found a free
/// motion. Its iterations are kept and are part of the limit. If no bound stops the motion, the status is not_held. It
/// is singular if even all bounds together leave the motion free. (collective)
void continue_proximal_points(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                              const Observer& observer, BoxSolution& so_far);

}  // namespace plastron::contact

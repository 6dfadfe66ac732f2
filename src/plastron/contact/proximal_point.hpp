// The way on from a set that leaves a motion free, though more active bounds would hold it: proximal points. From a centre z_k in the box
//   z_{k+1} = the minimiser of  J(z) + rho/2 (z - z_k)' D (z - z_k)  over the box,   D = diag A,
// a strictly convex program, which active sets solve with A + rho D in place of A. Then the ordinary method is tried from the set on which
// z_{k+1} was found; if it meets a free motion again, rho falls and z_{k+1} is the next centre. Why the sets become that of a solution, if
// there is one, is told in docs/methods/contact.md. Source: Rockafellar, Monotone operators and the proximal point algorithm (1976).
#pragma once
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/contact/subproblem.hpp>

namespace plastron::contact {

/// Goes on with a box problem, without equations, from the set `so_far.activity`, on which `subproblems` found a motion to be free; its
/// iterations are kept and count towards the limit. What no bound stops ends as not_held, and as singular if not even all bounds
/// together hold it. (collective)
void continue_proximal_points(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                              const Observer& observer, BoxSolution& so_far);

}  // namespace plastron::contact

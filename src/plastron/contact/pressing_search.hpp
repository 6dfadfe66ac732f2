// Pressing forces for solvers of fixed bounds only. This method is also the safeguard of the primal-dual method with
// pressing forces. The positions get a problem of their own: the function
//   phi(delta) = min { 1/2 z' A z - b' z : lower(delta) <= z <= upper(delta) } - F' delta
// is convex and piecewise quadratic. Each value is a program for any contact solver. Its gradient is R(delta) - F, the
// reactions minus the forces. On the pieces where the active set S stays, its Hessian is the border's z_k' A z_l
// (pressed_subproblem.hpp):
//   1. z(delta) and its active set S by the contact solver, started on the last S. A force that S does not carry moves
//      until it touches. phi decreases on the way, and z does not change.
//   2. delta* of the subproblem of S with its border. If its z satisfies all bounds and signs, it is the solution.
//   3. delta := delta + t (delta* - delta) with the first t of 1, 1/2, ... for which phi decreases, then step 1. The
//      criterion: the slope is still not positive, or phi is lower by a fraction of the slope. Where bounds would cross
//      on the way, delta* is the minimiser of S that leaves a tenth of their width. Where the border is singular on S,
//      the direction is the free motion, if the forces drive it, or F - R over a scale. Then t doubles while the slope
//      stays.
// This is Newton's method for a piecewise quadratic convex function, with phi as safeguard: phi decreases at every
// step. The proof is in docs/methods/pressing-obstacles.md. Source: Sun, On the structure of convex piecewise quadratic
// functions (1992); Qi and Sun, A nonsmooth version of Newton's method (1993).
#pragma once
#include <plastron/contact/solve.hpp>

namespace plastron::contact {

/// Solves the problem, starting from the bordered subproblem of `initial`. The iterations of `box_solver` and each
/// subproblem of step 2 are iterations of the solution. max_iterations limits their sum. Status infeasible: the forces
/// press bounds against each other. Status not_carried: phi decreases without limit. `box_solver` and the subproblem
/// treat the equations. (collective)
BoxSolution solve_by_pressing_search(const BoxProblem& problem, std::span<const Activity> initial,
                                     algebra::Preconditioner& preconditioner, const Settings& settings,
                                     const Observer& observer, SolverFunction& box_solver);

/// Continues from the positions and the active set of `so_far`. Its iterations are kept and are part of the limit.
/// Further ones are marked `safeguarded`. (collective)
void continue_pressing_search(const BoxProblem& problem, algebra::Preconditioner& preconditioner,
                              const Settings& settings, const Observer& observer, SolverFunction& box_solver,
                              BoxSolution& so_far);

}  // namespace plastron::contact

// Pressing forces for solvers that know fixed bounds only; and the safeguard of the primal-dual method with pressing forces. The positions
// get a problem of their own: the function
//   phi(delta) = min { 1/2 z' A z - b' z : lower(delta) <= z <= upper(delta) } - F' delta
// is convex and piecewise quadratic, each value is a program for any contact solver, and its gradient is R(delta) - F, the reactions
// minus the forces. On the pieces where the active set S stays, its Hessian is the border's z_k' A z_l (pressed_subproblem.hpp):
//   1. z(delta) and its active set S by the contact solver, begun on the last S. A force that S does not carry moves until it touches: phi
//      falls on the way, and z stays.
//   2. delta* of the subproblem of S with its border. If its z keeps all bounds and signs, it is the solution.
//   3. delta := delta + t (delta* - delta) with the first t of 1, 1/2, ... for which phi falls: its slope is still not positive, or it is
//      lower by a fraction of the slope; go to 1. Where bounds would cross on the way, delta* is the minimiser of S with
//      a tenth of their width left. Where the border is singular on S the direction is
//      the free motion, if the forces drive it, or F - R over a scale, and t doubles as long as the slope stays.
// Newton's method for a piecewise quadratic convex function, made safe by that function: phi falls at every step. The proof is in
// docs/methods/pressing-obstacles.md. Source: Sun, On the structure of convex piecewise quadratic functions (1992); Qi and Sun, A nonsmooth
// version of Newton's method (1993).
#pragma once
#include <plastron/contact/solve.hpp>

namespace plastron::contact {

/// Starts from the bordered subproblem of `initial`. The iterations of `box_solver` are those of the solution, and each subproblem of step
/// 2 is one; max_iterations limits their sum. Status infeasible where the forces press bounds against each other, not_carried where phi
/// falls without end. Equations are left to `box_solver` and the subproblem. (collective)
BoxSolution solve_by_pressing_search(const BoxProblem& problem, std::span<const Activity> initial,
                                     algebra::Preconditioner& preconditioner, const Settings& settings,
                                     const Observer& observer, SolverFunction& box_solver);

/// Goes on from the positions and the active set of `so_far`; its iterations are kept and count towards the limit, further ones are marked
/// `safeguarded`. (collective)
void continue_pressing_search(const BoxProblem& problem, algebra::Preconditioner& preconditioner,
                              const Settings& settings, const Observer& observer, SolverFunction& box_solver,
                              BoxSolution& so_far);

}  // namespace plastron::contact

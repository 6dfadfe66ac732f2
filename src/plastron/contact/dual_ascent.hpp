// Equations B z = 0 beside the bounds, for solvers that know boxes only; and the safeguard of the primal-dual method with equations.
// A projection onto the box leaves the equations, so they get multipliers q first:
//   d(q) = min { 1/2 z' A z - (b - B' q)' z : lower <= z <= upper }
// is a program with a box alone, for any contact solver. d is concave, d'(q) = B z(q) with z(q) the minimiser, and where d is greatest
// z(q) solves the whole problem. d is quadratic as long as the active set S of z(q) stays, and its maximiser there is the multiplier of
// the subproblem A z + B' q = b, B z = 0 on S:
//   1. z(q) and its active set S by the contact solver.
//   2. q* of the subproblem on S. If its z keeps all bounds and signs, it is the solution.
//   3. q := q + t (q* - q) with the first t of 1, 1/2, ... for which d rises by a fraction of its slope, and go to 1. Where the
//      equations cannot hold on S, the direction is P r instead, P the preconditioner of (B A^{-1} B')^{-1} and r what remains of d'(q)
//      however q is chosen on S; d is about linear along it, so t may double, too.
// This is Newton's method for a piecewise quadratic concave function, made safe by d itself: d rises at every step. Sources: Qi and Sun,
// A nonsmooth version of Newton's method (1993), for the steps; Bertsekas, Constrained optimization and Lagrange multiplier methods
// (1982), section 5.3, for the dual function.
#pragma once
#include <plastron/contact/solve.hpp>

namespace plastron::contact {

/// Starts from q = 0. The iterations of `box_solver` are those of the solution, and each subproblem of step 2 is one; max_iterations
/// limits their sum. A dual function that cannot rise beyond rounding before 2 ends it: status cycling; one that rises without end has
/// equations that cannot hold within the bounds: infeasible. (collective)
BoxSolution solve_by_dual_ascent(const BoxProblem& problem, std::span<const Activity> initial,
                                 algebra::Preconditioner& preconditioner, const Settings& settings,
                                 const Observer& observer, SolverFunction& box_solver);

/// Goes on from the multipliers q and the active set of `so_far`; its iterations are kept and count towards the limit, further ones
/// are marked `safeguarded`. (collective)
void continue_dual_ascent(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings,
                          const Observer& observer, SolverFunction& box_solver, BoxSolution& so_far);

}  // namespace plastron::contact

// Equations B z = 0 beside the bounds, for solvers of boxes only. This method is also the safeguard of the primal-dual
// method with equations. A projection onto the box violates the equations, so they get multipliers q first:
//   d(q) = min { 1/2 z' A z - (b - B' q)' z : lower <= z <= upper }
// is a program with a box alone, for any contact solver. d is concave, and d'(q) = B z(q) with z(q) the minimiser. At
// the maximum of d, z(q) solves the whole problem. d is quadratic while the active set S of z(q) stays. Its maximiser
// there is the multiplier of the subproblem A z + B' q = b, B z = 0 on S:
//   1. z(q) and its active set S by the contact solver.
//   2. q* of the subproblem on S. If its z satisfies all bounds and signs, it is the solution.
//   3. q := q + t (q* - q) with the first t of 1, 1/2, ... for which d increases by a fraction of its slope, then step
//      1. Where the equations cannot be satisfied on S, the direction is P r instead. P is the preconditioner of (B
//      A^{-1} B')^{-1}. r is the part of d'(q) that remains for every q on S. d is nearly linear along it, so t may
//      also double.
// This is Newton's method for a piecewise quadratic concave function, with d as safeguard: d increases at every step.
// Sources: Qi and Sun, A nonsmooth version of Newton's method (1993), for the steps; Bertsekas, Constrained
// optimization and Lagrange multiplier methods (1982), section 5.3, for the dual function.
#pragma once
#include <plastron/contact/solve.hpp>

namespace plastron::contact {

/// Solves the problem from q = 0. The iterations of `box_solver` and each subproblem of step 2 are iterations of the
/// solution. max_iterations limits their sum. Status cycling: the dual function cannot increase beyond rounding before
/// step 2 ends it. Status infeasible: it increases without limit, so the equations cannot be satisfied within the
/// bounds. (collective)
BoxSolution solve_by_dual_ascent(const BoxProblem& problem, std::span<const Activity> initial,
                                 algebra::Preconditioner& preconditioner, const Settings& settings,
                                 const Observer& observer, SolverFunction& box_solver);

/// Continues from the multipliers q and the active set of `so_far`. Its iterations are kept and are part of the limit.
/// Further ones are marked `safeguarded`. (collective)
void continue_dual_ascent(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings,
                          const Observer& observer, SolverFunction& box_solver, BoxSolution& so_far);

}  // namespace plastron::contact

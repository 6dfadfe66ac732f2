// The common part of the contact solvers that use PETSc's bounded Newton methods:
//   1. The minimiser on the subproblem of the initial set (with all bounds active if that set has none), projected on
//      the box.
//   2. PETSc's method starts there in the unknowns x = D^{1/2} z / s, D the diagonal of A, s a norm of the load. Its
//      matrix has a unit diagonal, so PETSc's norms and tolerances do not depend on units of length or force. Its
//      linear systems are solved with our preconditioner and conjugate gradients through problem.apply. PETSc chooses
//      sets, steps and line searches.
//   3. One polish: the subproblem of PETSc's last active set, solved and judged as in the other solvers. The reason:
//      PETSc stops at a residual of 1e-8, and the certificate requires rounding accuracy. If nothing changes, this is
//      the solution.
//   4. Otherwise (PETSc failed, or decided a tie differently) the projected search continues from PETSc's last point.
//      Its iterations are marked `safeguarded`.
#pragma once
#include <plastron/algebra/bounded_newton.hpp>
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <span>

namespace plastron::contact {

using BoundedNewton = algebra::BoundedNewtonEnd(const algebra::BoundedQuadratic& problem,
                                                const algebra::BoundedNewtonSettings& settings, algebra::Vector& x);

/// Solves a problem without equations. An iteration of PETSc is an iteration of the solution, and so is the polish.
/// max_iterations limits their sum. (collective)
BoxSolution solve_by_bounded_newton(const BoxProblem& problem, std::span<const Activity> initial,
                                    algebra::Preconditioner& preconditioner, const Settings& settings,
                                    const Observer& observer, BoundedNewton& method);

}  // namespace plastron::contact

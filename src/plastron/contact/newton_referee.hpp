// What the solvers that PETSc's bounded Newton methods make of a contact problem have in common:
//   1. The minimiser on the subproblem of the initial set (with all bounds active if that has none), projected on the box.
//   2. PETSc's method from there in the unknowns x = D^{1/2} z / s, D the diagonal of A, s a norm of the load: its matrix has a unit
//      diagonal, so no unit of length or force decides about PETSc's norms and tolerances. Its linear systems are solved with our
//      preconditioner and conjugate gradients through problem.apply; PETSc chooses sets, steps and line searches.
//   3. One polish: the subproblem of PETSc's last active set, solved and judged as in the other solvers, since PETSc stops at a
//      residual of 1e-8 and the certificate asks for rounding. If nothing changes, that is the solution.
//   4. Otherwise (PETSc gave up, or a tie was decided the other way) the projected search goes on from PETSc's last point; its
//      iterations are marked `safeguarded`.
#pragma once
#include <plastron/algebra/bounded_newton.hpp>
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <span>

namespace plastron::contact {

using BoundedNewton = algebra::BoundedNewtonEnd(const algebra::BoundedQuadratic& problem,
                                                const algebra::BoundedNewtonSettings& settings, algebra::Vector& x);

/// Without equations. An iteration of PETSc's is one of the solution's, and so is the polish; max_iterations limits their sum.
/// (collective)
BoxSolution solve_by_bounded_newton(const BoxProblem& problem, std::span<const Activity> initial,
                                    algebra::Preconditioner& preconditioner, const Settings& settings,
                                    const Observer& observer, BoundedNewton& method);

}  // namespace plastron::contact

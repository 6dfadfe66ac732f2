// Modified proportioning with reduced gradient projections, preconditioned in the face: the solver without factor
// updates. One factorisation, or one setup of any preconditioner, serves all faces. Every other step costs products
// with A. Sources: Dostal and Schoeberl, Minimizing quadratic functions subject to bound constraints with the rate of
// convergence and finite termination (2005); Dostal, Optimal quadratic programming algorithms (2009), both bounds:
// section 5.8, faces preconditioned: section 5.10; the projected conjugate-gradient step: Kruzik, Horak, Cermak,
// Pospisil, Pecha (2020). Symbols are as in docs/methods/mprgp.md.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <span>

namespace plastron::contact {

/// Solves the problem. The preconditioner is pinned once, on the starting set: `initial`, or all bounds active if a
/// motion is free there. An iteration of the solution ends with the release of unknowns or with the end of the solver.
/// Conjugate-gradient steps and expansions are its linear_steps. At most settings.max_iterative_steps are allowed
/// (beyond: status linear_solver_stalled). Equations are solved by dual ascent (dual_ascent.hpp). (collective)
BoxSolution solve_mprgp(const BoxProblem& problem, std::span<const Activity> initial,
                        algebra::Preconditioner& preconditioner, const Settings& settings = {},
                        const Observer& observer = {});

}  // namespace plastron::contact

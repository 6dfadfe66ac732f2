// Contact by PETSc's SNES: the reduced-space Newton method for variational inequalities, SNESVINEWTONRSLS
// (algebra/bounded_newton.hpp). It solves the box complementarity problem  l <= z <= u  _|_  A z - b, followed by a
// polish.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <span>

namespace plastron::contact {

/// Solves by solve_by_bounded_newton (newton_referee.hpp), with equations by dual ascent (dual_ascent.hpp).
/// (collective)
BoxSolution solve_snesvi(const BoxProblem& problem, std::span<const Activity> initial,
                         algebra::Preconditioner& preconditioner, const Settings& settings = {},
                         const Observer& observer = {});

}  // namespace plastron::contact

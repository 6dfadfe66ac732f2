// Contact by PETSc's TAO: its bounded Newton method with a line search, TAOBNLS (algebra/bounded_newton.hpp), followed
// by a polish.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <span>

namespace plastron::contact {

/// Solves by solve_by_bounded_newton (newton_referee.hpp), with equations by dual ascent (dual_ascent.hpp).
/// (collective)
BoxSolution solve_tao(const BoxProblem& problem, std::span<const Activity> initial,
                      algebra::Preconditioner& preconditioner, const Settings& settings = {},
                      const Observer& observer = {});

}  // namespace plastron::contact

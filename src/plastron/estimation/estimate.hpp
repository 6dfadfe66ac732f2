// Estimates the errors of a solution on one mesh, with the factor of the last contact step: the error in the energy norm
// by cell, the errors of goals, and the distance from buckling. Goals need dual problems on the final active set
// (docs/methods/estimates.md).
#pragma once
#include <plastron/estimation/derivatives.hpp>
#include <plastron/estimation/estimates.hpp>

#include <optional>
#include <span>

namespace plastron::estimation {

/// Computes the estimates (collective). `preconditioner` belongs to solved.box.matrix. It is factorised again for the
/// final set if there is a dual problem.
Estimates estimate(const Solved& solved, algebra::Preconditioner& preconditioner, std::span<const Goal> goals);

/// Returns the largest mu with -K_N v = mu A v, K_N the geometric stiffness of the membrane forces, with fixed contact: a
/// perfect shell buckles at 1. Empty if linear equations could not be solved (collective).
std::optional<double> buckling(const Solved& solved, algebra::Preconditioner& preconditioner);

}  // namespace plastron::estimation

// Estimates the errors of a solution on one mesh, with the factor of the last contact step: the error in the energy norm
// by cell, the errors of goals, and the difference between the linear model and finite displacements. Goals need dual
// problems on the final active set (docs/methods/estimates.md).
#pragma once
#include <plastron/estimation/derivatives.hpp>
#include <plastron/estimation/estimates.hpp>

#include <span>

namespace plastron::estimation {

/// Computes the estimates (collective). `preconditioner` belongs to solved.box.matrix. It is factorised again for the
/// final set if there is a dual problem.
Estimates estimate(const Solved& solved, algebra::Preconditioner& preconditioner, std::span<const Goal> goals);

/// Computes the energy that the linear model cannot avoid, and the distance of membrane forces from buckling
/// (docs/theory.md, "What linearity leaves out"); empty if linear equations could not be solved. `buckling` is also empty if it is not wanted
/// (collective).
Linearity linearity(const Solved& solved, algebra::Preconditioner& preconditioner, bool wants_buckling);

}  // namespace plastron::estimation

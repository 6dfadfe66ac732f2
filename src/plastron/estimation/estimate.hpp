// The estimated error of a solution on one mesh: the error in the energy norm, cell by cell, and the errors of goals.
// Goals need dual problems on the final active set (docs/methods/estimates.md).
#pragma once
#include <plastron/estimation/derivatives.hpp>
#include <plastron/estimation/estimates.hpp>

#include <span>

namespace plastron::estimation {

/// Computes the estimates (collective). `preconditioner` belongs to solved.box.matrix. It is pinned again for the
/// final set if there is a dual problem.
Estimates estimate(const Solved& solved, algebra::Preconditioner& preconditioner, std::span<const Goal> goals);

}  // namespace plastron::estimation

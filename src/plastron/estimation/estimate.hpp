// How far a solution on one mesh is from the exact one: the error in the energy norm, cell by cell, and that of numbers asked for, by dual
// problems on the final active set (docs/methods/estimates.md).
#pragma once
#include <plastron/estimation/derivatives.hpp>
#include <plastron/estimation/estimates.hpp>

#include <span>

namespace plastron::estimation {

/// `preconditioner` belongs to solved.box.matrix; it is pinned anew for the final set if there is a dual problem to solve. (collective)
Estimates estimate(const Solved& solved, algebra::Preconditioner& preconditioner, std::span<const Goal> goals);

}  // namespace plastron::estimation

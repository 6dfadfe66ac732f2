// The difference between the linear model and finite displacements: the unavoidable energy, and the distance of
// membrane forces from buckling (docs/theory.md, "What linearity leaves out"). Uses the factor of the last contact
// step.
#pragma once
#include <plastron/estimation/derivatives.hpp>
#include <plastron/estimation/estimates.hpp>

namespace plastron::estimation {

/// Returns the results; empty if linear equations could not be solved. `buckling` is also empty if it is not wanted
/// (collective).
Linearity linearity(const Solved& solved, algebra::Preconditioner& preconditioner, bool wants_buckling);

}  // namespace plastron::estimation

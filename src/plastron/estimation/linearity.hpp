// How far a solution of the linear model is from what finite displacements would make of it, by the factor of the last contact step: the
// energy that the shell cannot avoid, and how near its membrane forces are to buckling (docs/theory.md, "What linearity leaves out").
#pragma once
#include <plastron/estimation/derivatives.hpp>
#include <plastron/estimation/estimates.hpp>

namespace plastron::estimation {

/// Empty where linear equations could not be solved, `buckling` also where it is not wanted (collective).
Linearity linearity(const Solved& solved, algebra::Preconditioner& preconditioner, bool wants_buckling);

}  // namespace plastron::estimation

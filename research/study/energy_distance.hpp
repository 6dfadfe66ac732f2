// How far two solutions on one mesh are apart in the energy norm, and from where on that is more than noise.
#pragma once
#include <plastron/computation/result.hpp>

namespace plastron::study {

/// The relative error of the solver's solution in the energy norm: its tolerance is a thousandth of it.
constexpr double solver_noise = 1e-9;

/// With a relative noise beyond it a solution says nothing.
constexpr double too_noisy = 1e-2;

/// The energy norm that rounding errors of the nodal values have by themselves, strains of eps |u| / h and the like; where supports
/// prescribe motions the solver leaves more than rounding
/// [J^{1/2}]. (collective)
double rounding_norm(const computation::Solution& solution);

/// The part of |U|_a = `energy_norm` that is noise: the solver's, or more where rounding leaves less of U's digits (a shell
/// that moves as a rigid body); infinite for U = 0. (collective)
double relative_noise(const computation::Solution& solution, double energy_norm);

/// |y - reference|_a / |reference|_a; NaN where the reference has no energy. (collective)
double relative_distance(const assembly::ShellOperator& shell, algebra::Vector y, const algebra::Vector& reference);

}  // namespace plastron::study

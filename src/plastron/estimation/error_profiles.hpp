// The distribution of a cell's error along its two directions: it shows which direction needs refinement, and where.
#pragma once
#include <plastron/estimation/estimates.hpp>
#include <plastron/estimation/strain_errors.hpp>

#include <vector>

namespace plastron::estimation {

/// Returns the profile of each quadrilateral; empty for triangles. The error is expanded in products of Legendre
/// polynomials P_i(xi_1) P_j(xi_2), orthonormal at the quadrature points. The part i^2 / (i^2 + j^2) of each squared
/// coefficient counts as a change along xi_1, and half of a constant.
std::vector<ErrorProfile> error_profiles(const assembly::ShellOperator& shell, const std::vector<StrainErrors>& errors);

}  // namespace plastron::estimation

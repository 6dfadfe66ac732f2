// Along which of its two directions a cell is too long for what happens in it, and where in it that happens.
#pragma once
#include <plastron/estimation/estimates.hpp>
#include <plastron/estimation/strain_errors.hpp>

#include <vector>

namespace plastron::estimation {

/// Of each quadrilateral, none of triangles. The error is written in products of Legendre polynomials P_i(xi_1) P_j(xi_2), orthonormal at the
/// quadrature points; of the square of each coefficient i^2 / (i^2 + j^2) changes along xi_1, and half of a constant.
std::vector<ErrorProfile> error_profiles(const assembly::ShellOperator& shell, const std::vector<StrainErrors>& errors);

}  // namespace plastron::estimation

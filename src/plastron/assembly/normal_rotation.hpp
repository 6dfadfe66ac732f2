// The form of (M13) and (M14) on the discrete shell,
//   int E e^3 a^{ab} d_a(r . a_3) d_b(s . a_3) sqrt(a) dx   (times a dimensionless factor),
// invariant in place of the printed d_a(.) d_a(.); E e^3 gives it the unit of an energy.
#pragma once
#include <plastron/assembly/shell_operator.hpp>

namespace plastron::assembly {

/// One row for each quadrature point: d_1(r . a_3), d_2(r . a_3) along the cell's coordinates.
using CellGradient = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

CellGradient normal_rotation_gradients(const ShellOperator& shell, std::size_t cell, const element::CellField& field);
/// Adds the nodal forces of `stresses`: the transpose of normal_rotation_gradients().
void add_normal_rotation_forces(const ShellOperator& shell, std::size_t cell, const CellGradient& stresses,
                                element::CellField& forces);

/// Adds the product of factor times the form's operator with y to f's local values, for this rank's cells. Needs y's
/// ghosts. f.accumulate_ghosts() then completes the sum.
void add_normal_rotation_form(const ShellOperator& shell, double factor, const algebra::Vector& y, algebra::Vector& f);
/// Returns 1/2 factor times the form's value at (y, y), over all ranks (collective) [J].
double tangency_energy(const ShellOperator& shell, double factor, const algebra::Vector& y);
/// Returns R, where R' R is the element matrix of factor times the form.
RowMatrix scaled_normal_rotation_matrix(const ShellOperator& shell, std::size_t cell, double factor);

}  // namespace plastron::assembly

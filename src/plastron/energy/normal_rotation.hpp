// The normal rotation r . a_3 on the discrete shell. The penalised and the mixed formulation have the form of (M13) and
// (M14),
//   int E e^3 a^{ab} d_a(r . a_3) d_b(s . a_3) sqrt(a) dx   (times a dimensionless factor),
// invariant in place of the printed d_a(.) d_a(.); E e^3 gives it the unit of an energy. The mixed formulation also has
// a multiplier lambda (M14) of r's degree, zero where a support prescribes r . a_3 (H^1_{Gamma_0}). The form that couples
// lambda to the rotation is
//   b(V, q) = int a^{ab} d_a(s . a_3) d_b q sqrt(a) dx   (lambda [N m]).
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/energy/term.hpp>

#include <vector>

namespace plastron::energy {

/// One row for each quadrature point: d_1(r . a_3), d_2(r . a_3) along the cell's coordinates.
using CellGradient = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

CellGradient normal_rotation_gradients(const ShellOperator& shell, std::size_t cell, const element::CellField& field);

/// Adds the product of factor times the form's operator with y to f's local values, for this rank's cells. Needs y's
/// ghosts. f.accumulate_ghosts() then completes the sum.
void add_normal_rotation_form(const ShellOperator& shell, double factor, const algebra::Vector& y, algebra::Vector& f);
/// Returns 1/2 factor times the form's value at (y, y), over all ranks (collective) [J].
double tangency_energy(const ShellOperator& shell, double factor, const algebra::Vector& y);
/// Returns R, where R' R is the element matrix of factor times the form.
RowMatrix scaled_normal_rotation_matrix(const ShellOperator& shell, std::size_t cell, double factor);
/// Returns factor times the form as a term of the potential.
std::shared_ptr<const Term> normal_rotation_term(double factor);

/// Computes q_i = b(y, N_i), complete on owned nodes. Needs y's ghosts (collective).
void apply_coupling(const ShellOperator& shell, const algebra::Vector& y, algebra::Vector& q);
/// Computes f_j = b(phi_j, lambda) as Cartesian nodal forces, complete on owned nodes. Needs lambda's ghosts, and sets
/// the values of its constrained nodes (collective).
void apply_coupling_transposed(const ShellOperator& shell, algebra::Vector& lambda, algebra::Vector& f);
/// Returns the matrix of int a^{ab} d_a p d_b q sqrt(a) dx, one scalar for each node (collective).
algebra::Matrix gradient_matrix(const ShellOperator& shell);
/// Returns (int a^{ab} d_a q d_b q sqrt(a) dx)^{1/2} over all ranks (collective). Needs q's ghosts.
double gradient_norm(const ShellOperator& shell, const algebra::Vector& q);

}  // namespace plastron::energy

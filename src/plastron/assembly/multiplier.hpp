// The multiplier lambda of the mixed formulation (M14): continuous, of r's degree, zero where a support prescribes
// r . a_3 (H^1_{Gamma_0}), and the form that couples it to the rotation,
//   b(V, q) = int a^{ab} d_a(s . a_3) d_b q sqrt(a) dx   (lambda [N m]).
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/assembly/normal_rotation.hpp>

#include <vector>

namespace plastron::assembly {

/// Marks the owned nodes where lambda = 0. Precondition: the coordinates belong to a relaxed formulation.
std::vector<char> multiplier_zeros(const NodalCoordinates& coordinates, const algebra::Layout& layout);

/// Computes q_i = b(y, N_i), complete on owned nodes. Needs y's ghosts (collective).
void apply_coupling(const ShellOperator& shell, const algebra::Vector& y, algebra::Vector& q);
/// Computes f_j = b(phi_j, lambda) as Cartesian nodal forces, complete on owned nodes. Needs lambda's ghosts, and sets
/// the values of its tied nodes (collective).
void apply_coupling_transposed(const ShellOperator& shell, algebra::Vector& lambda, algebra::Vector& f);
/// Returns the matrix of int a^{ab} d_a p d_b q sqrt(a) dx, one scalar for each node (collective).
algebra::Matrix gradient_matrix(const ShellOperator& shell);
/// Returns (int a^{ab} d_a q d_b q sqrt(a) dx)^{1/2} over all ranks (collective). Needs q's ghosts.
double gradient_norm(const ShellOperator& shell, const algebra::Vector& q);

}  // namespace plastron::assembly

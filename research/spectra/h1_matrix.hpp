// Matrices of the H^1 norms that the estimates of the paper are written in, (2) there:
//   |V|_X^2 = 1/L^2 int |v|^2 / L^2 + |s|^2 + a^{ab} (d_a v . d_b v + L^2 d_a s . d_b s) sqrt(a) dx,
//   |q|_1^2 = 1/L^2 int q^2 / L^2 + a^{ab} d_a q d_b q sqrt(a) dx,
// invariant in place of the printed derivatives. The terms of the printed norm have different units; here L, a length of the
// shell's own, is the unit of length, so the norms are pure numbers (of a q in metres), and constants measured in them are
// the same in metres and in millimetres.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/assembly/shell_operator.hpp>

namespace plastron::spectra {

using assembly::RowMatrix;
using geometry::Vector3d;

/// z' X z = |V|_X^2 for V with nodal coordinates z and L = `length` [m], in the pattern of stiffness_matrix() (collective).
algebra::Matrix h1_matrix(const assembly::ShellOperator& shell, const assembly::NodalCoordinates& coordinates,
                          double length);
/// q' K q = |q|_1^2 for scalar nodal values (collective).
algebra::Matrix scalar_h1_matrix(const assembly::ShellOperator& shell, double length);

}  // namespace plastron::spectra

// Matrices of the H^1 norms that the estimates of the paper are written in, (2) there:
//   |V|_X^2 = int |v|^2 + |s|^2 + a^{ab} (d_a v . d_b v + d_a s . d_b s) sqrt(a) dx,    |q|_1^2 = int q^2 + a^{ab} d_a q d_b q sqrt(a) dx
// invariant in place of the printed derivatives. The terms have different units: lengths count in metres, so the norms, and
// constants measured in them, belong to the unit of length of the case.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/assembly/shell_operator.hpp>

namespace plastron::assembly {

/// z' X z = |V|_X^2 for V with nodal coordinates z, in the pattern of stiffness_matrix() (collective).
algebra::Matrix h1_matrix(const ShellOperator& shell, const NodalCoordinates& coordinates);
/// q' K q = |q|_1^2 for scalar nodal values (collective).
algebra::Matrix scalar_h1_matrix(const ShellOperator& shell);

}  // namespace plastron::assembly

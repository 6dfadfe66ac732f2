// The stiffness matrix in nodal coordinates, to be factorised: A = T' (B' C B) T.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/assembly/shell_operator.hpp>

namespace plastron::assembly {

/// Cartesian element matrix, 6 values for each node.
RowMatrix element_stiffness(const ShellOperator& shell, std::size_t cell);

/// Returns the matrix of a(., .) plus `tangency_factor` times the form of normal_rotation.hpp (collective).
algebra::Matrix stiffness_matrix(const ShellOperator& shell, const NodalCoordinates& coordinates,
                                 double tangency_factor = 0);

}  // namespace plastron::assembly

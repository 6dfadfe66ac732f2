// Matrices of a cell whose blocks between two nodes are multiples of the 3 x 3 unit matrix: geometric stiffness and mass.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>

#include <Eigen/Core>

namespace plastron::finite {

/// The factors of the unit matrix, a row and a column for each node: between displacements, between a displacement (row) and a
/// rotation, between rotations.
struct ScalarBlocks {
  Eigen::MatrixXd of_u, of_u_and_r, of_r;
};

/// Returns zeros for a cell of so many nodes.
ScalarBlocks zero_blocks(int nodes);

/// Returns the sum over points p of weight_p a_pi b_pj.
Eigen::MatrixXd weighted_product(const Eigen::MatrixXd& a, const Eigen::VectorXd& weights, const Eigen::MatrixXd& b);

/// Transforms the matrix on (u, r) of the cell's nodes to nodal coordinates, on both sides.
constraints::NodeColumns in_coordinates(const assembly::NodalCoordinates& coordinates, std::size_t cell,
                                        const ScalarBlocks& blocks);

}  // namespace plastron::finite

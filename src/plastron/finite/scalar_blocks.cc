#include <plastron/finite/scalar_blocks.hpp>

namespace plastron::finite {

using assembly::RowMatrix;

ScalarBlocks zero_blocks(int nodes) {
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(nodes, nodes);
  return {zero, zero, zero};
}

Eigen::MatrixXd weighted_product(const Eigen::MatrixXd& a, const Eigen::VectorXd& weights, const Eigen::MatrixXd& b) {
  return a.transpose() * weights.asDiagonal() * b;
}

constraints::NodeColumns in_coordinates(const assembly::NodalCoordinates& coordinates, std::size_t cell,
                                        const ScalarBlocks& blocks) {
  RowMatrix k = RowMatrix::Zero(6 * blocks.of_u.rows(), 6 * blocks.of_u.rows());
  for (Eigen::Index i = 0; i < blocks.of_u.rows(); ++i)
    for (Eigen::Index j = 0; j < blocks.of_u.cols(); ++j) {
      k.block<3, 3>(6 * i, 6 * j).diagonal().setConstant(blocks.of_u(i, j));
      k.block<3, 3>(6 * i, 6 * j + 3).diagonal().setConstant(blocks.of_u_and_r(i, j));
      k.block<3, 3>(6 * j + 3, 6 * i).diagonal().setConstant(blocks.of_u_and_r(i, j));
      k.block<3, 3>(6 * i + 3, 6 * j + 3).diagonal().setConstant(blocks.of_r(i, j));
    }
  return on_both_sides(coordinates, coordinates.space->nodes(cell), std::move(k));
}

}  // namespace plastron::finite

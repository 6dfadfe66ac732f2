#include <plastron/assembly/stiffness.hpp>

#include <plastron/assembly/normal_rotation.hpp>
#include <plastron/fem/carried_nodes.hpp>

#include <Eigen/Cholesky>

namespace plastron::assembly {

namespace {

/// C' B with C C' the weighted section stiffness at each point, so that the element matrix is (C' B)' (C' B).
void scale_by_stiffness(const ShellOperator& shell, std::size_t cell, RowMatrix& b) {
  for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
    const QuadraturePoint& p = shell.point(cell, q);
    const double root = std::sqrt(p.area);
    const Eigen::Matrix3d membrane = root * p.stiffness.membrane.llt().matrixU().toDenseMatrix();
    const Eigen::Matrix3d bending = root * p.stiffness.bending.llt().matrixU().toDenseMatrix();
    const Eigen::Matrix2d shear = root * p.stiffness.shear.llt().matrixU().toDenseMatrix();
    b.middleRows<3>(8 * q) = (membrane * b.middleRows<3>(8 * q)).eval();
    b.middleRows<3>(8 * q + 3) = (bending * b.middleRows<3>(8 * q + 3)).eval();
    b.middleRows<2>(8 * q + 6) = (shear * b.middleRows<2>(8 * q + 6)).eval();
  }
}

RowMatrix gram(const RowMatrix& b) {
  RowMatrix k = RowMatrix::Zero(b.cols(), b.cols());
  k.selfadjointView<Eigen::Lower>().rankUpdate(b.transpose());
  k.triangularView<Eigen::StrictlyUpper>() = k.transpose();
  return k;
}

}  // namespace

RowMatrix element_stiffness(const ShellOperator& shell, std::size_t cell) {
  RowMatrix b = shell.strain_matrix(cell);
  scale_by_stiffness(shell, cell, b);
  return gram(b);
}

algebra::Matrix stiffness_matrix(const ShellOperator& shell, const NodalCoordinates& coordinates,
                                 double tangency_factor) {
  const fem::Space& space = shell.space();
  algebra::Matrix matrix(space.layout, coordinates.width, fem::coupled_carriers(space));
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    auto [nodes, b] = in_coordinates(coordinates, c, shell.strain_matrix(c));
    scale_by_stiffness(shell, c, b);
    RowMatrix k = gram(b);
    if (tangency_factor > 0)
      k += gram(in_coordinates(coordinates, c, scaled_normal_rotation_matrix(shell, c, tangency_factor)).matrix);
    matrix.add(nodes, {k.data(), static_cast<std::size_t>(k.size())});
  }
  matrix.finish();
  return matrix;
}

}  // namespace plastron::assembly

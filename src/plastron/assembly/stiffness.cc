#include <plastron/assembly/stiffness.hpp>

#include <plastron/assembly/normal_rotation.hpp>
#include <plastron/fem/constraints.hpp>

#include <Eigen/Cholesky>

namespace plastron::assembly {

namespace {

/// Multiplies rows from `first` on, in place, by the transpose of the Cholesky factor of a point's stiffness times its
/// area.
template <int size>
void scale_rows(const Eigen::Matrix<double, size, size>& stiffness, double area, Eigen::Index first, RowMatrix& b) {
  const Eigen::Matrix<double, size, size> upper = std::sqrt(area) * stiffness.llt().matrixU().toDenseMatrix();
  for (int i = 0; i < size; ++i) {
    b.row(first + i) *= upper(i, i);
    for (int j = i + 1; j < size; ++j) b.row(first + i) += upper(i, j) * b.row(first + j);
  }
}

/// Computes C' B, where C C' is the weighted section stiffness at each point. The element matrix is then (C' B)'
/// (C' B).
void scale_by_stiffness(const ShellOperator& shell, std::size_t cell, RowMatrix& b) {
  for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
    const QuadraturePoint p = shell.point(cell, q);
    scale_rows(p.stiffness.membrane, p.area, 8 * q, b);
    scale_rows(p.stiffness.bending, p.area, 8 * q + 3, b);
    scale_rows(p.stiffness.shear, p.area, 8 * q + 6, b);
  }
}

RowMatrix gram(const ShellOperator& shell, const RowMatrix& b) {
  RowMatrix k(b.cols(), b.cols());
  shell.kernels().gram(b.data(), static_cast<int>(b.rows()), static_cast<int>(b.cols()), k.data());
  k.triangularView<Eigen::StrictlyUpper>() = k.transpose();
  return k;
}

}  // namespace

RowMatrix element_stiffness(const ShellOperator& shell, std::size_t cell) {
  RowMatrix b = shell.strain_matrix(cell);
  scale_by_stiffness(shell, cell, b);
  return gram(shell, b);
}

algebra::Matrix stiffness_matrix(const ShellOperator& shell, const NodalCoordinates& coordinates,
                                 double tangency_factor) {
  const fem::Space& space = shell.space();
  algebra::Matrix matrix(space.layout, coordinates.width, fem::coupled_carriers(space));
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    auto [nodes, b] = in_coordinates(coordinates, c, shell.strain_matrix(c));
    scale_by_stiffness(shell, c, b);
    RowMatrix k = gram(shell, b);
    if (tangency_factor > 0)
      k += gram(shell, in_coordinates(coordinates, c, scaled_normal_rotation_matrix(shell, c, tangency_factor)).matrix);
    matrix.add(nodes, {k.data(), static_cast<std::size_t>(k.size())});
  }
  matrix.finish();
  return matrix;
}

}  // namespace plastron::assembly

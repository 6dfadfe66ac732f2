#include <research/spectra/spectra.hpp>

#include <Eigen/Cholesky>

namespace plastron::spectra {

namespace {

using assembly::Vector6;

/// Scalar element matrix: 1/L^2 int N_i N_j / L^2 + a^{ab} d_a N_i d_b N_j sqrt(a) dx. That of s is L^2 times as large.
assembly::RowMatrix scalar_element(const energy::ShellOperator& shell, std::size_t cell, double length) {
  const double unit_area = length * length;
  const element::BasisAt& basis = shell.tables().quadrature;
  assembly::RowMatrix k = assembly::RowMatrix::Zero(basis.value.cols(), basis.value.cols());
  for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
    const energy::QuadraturePoint& p = shell.point(cell, q);
    Eigen::Matrix2Xd g(2, basis.value.cols());
    g << basis.d1.row(q), basis.d2.row(q);
    k += p.area / unit_area *
         (basis.value.row(q).transpose() * basis.value.row(q) / unit_area + g.transpose() * p.frame.metric_con * g);
  }
  return k;
}

/// Cartesian element matrix, 6 values a node, for values interpolated in moving bases (M15): field by field.
assembly::RowMatrix covariant_element(const energy::ShellOperator& shell, std::size_t cell, double length) {
  const int points = shell.tables().points_per_cell(), columns = 6 * shell.tables().nodes_per_cell();
  assembly::RowMatrix value(6 * points, columns), d1 = value, d2 = value;
  element::CellField unit = element::CellField::Zero(shell.tables().nodes_per_cell(), 6);
  for (int c = 0; c < columns; ++c) {
    unit.data()[c] = 1;
    const element::FieldRows rows =
        shell.interpolation().fields(cell, shell.tables().quadrature, shell.quadrature_bases(cell), unit);
    unit.data()[c] = 0;
    value.col(c) = Eigen::Map<const Eigen::VectorXd>(rows.value.data(), rows.value.size());
    d1.col(c) = Eigen::Map<const Eigen::VectorXd>(rows.d1.data(), rows.d1.size());
    d2.col(c) = Eigen::Map<const Eigen::VectorXd>(rows.d2.data(), rows.d2.size());
  }
  for (int q = 0; q < points; ++q) {
    const energy::QuadraturePoint& p = shell.point(cell, q);
    const double area = p.area / (length * length);
    const Eigen::Matrix2d root = (area * p.frame.metric_con).llt().matrixU();
    value.middleRows<6>(6 * q) *= std::sqrt(area) / length;
    d1.middleRows<6>(6 * q) = (root(0, 0) * d1.middleRows<6>(6 * q) + root(0, 1) * d2.middleRows<6>(6 * q)).eval();
    d2.middleRows<6>(6 * q) *= root(1, 1);
    for (assembly::RowMatrix* rows : {&value, &d1, &d2}) rows->middleRows<3>(6 * q + 3) *= length;
  }
  return value.transpose() * value + d1.transpose() * d1 + d2.transpose() * d2;
}

/// Diagonal blocks from a scalar element matrix.
assembly::RowMatrix by_components(const assembly::RowMatrix& scalar, const Vector6& weights) {
  assembly::RowMatrix cartesian = assembly::RowMatrix::Zero(6 * scalar.rows(), 6 * scalar.cols());
  for (Eigen::Index i = 0; i < scalar.rows(); ++i)
    for (Eigen::Index j = 0; j < scalar.cols(); ++j)
      cartesian.block<6, 6>(6 * i, 6 * j).diagonal() = scalar(i, j) * weights;
  return cartesian;
}

}  // namespace

algebra::Matrix h1_matrix(const energy::ShellOperator& shell, const assembly::NodalCoordinates& coordinates,
                          double length) {
  const double weight_of_s = length * length;
  const Vector6 weights = (Vector6() << 1, 1, 1, weight_of_s, weight_of_s, weight_of_s).finished();
  const fem::Space& space = shell.space();
  algebra::Matrix matrix(space.layout, coordinates.width, space.couplings());
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const assembly::RowMatrix cartesian = shell.quadrature_bases(c).empty()
                                              ? by_components(scalar_element(shell, c, length), weights)
                                              : covariant_element(shell, c, length);
    // C' K C from K C, for K is symmetric.
    const assembly::RowMatrix half =
        assembly::in_coordinates(coordinates, coordinates.space->nodes(c), cartesian).matrix.transpose();
    const auto k = assembly::in_coordinates(coordinates, coordinates.space->nodes(c), half);
    matrix.add(k.nodes, {k.matrix.data(), static_cast<std::size_t>(k.matrix.size())});
  }
  matrix.finish();
  return matrix;
}

algebra::Matrix scalar_h1_matrix(const energy::ShellOperator& shell, double length) {
  const fem::Space& space = shell.space();
  algebra::Matrix matrix(space.layout, 1, space.continuity.couplings(space.connectivity));
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const assembly::RowMatrix half =
        space.continuity.on_sources(space.nodes(c), scalar_element(shell, c, length)).matrix.transpose();
    const auto k = space.continuity.on_sources(space.nodes(c), half);
    matrix.add(k.nodes, {k.matrix.data(), static_cast<std::size_t>(k.matrix.size())});
  }
  matrix.finish();
  return matrix;
}

}  // namespace plastron::spectra

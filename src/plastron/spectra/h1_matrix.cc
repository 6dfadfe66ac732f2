#include <plastron/spectra/h1_matrix.hpp>

#include <plastron/fem/ties.hpp>

#include <Eigen/Cholesky>

namespace plastron::spectra {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Scalar element matrix: 1/L^2 int N_i N_j / L^2 + a^{ab} d_a N_i d_b N_j sqrt(a) dx. That of s is L^2 times as large.
assembly::RowMatrix scalar_element(const assembly::ShellOperator& shell, std::size_t cell, double length) {
  const double unit_area = length * length;
  const element::BasisAt& basis = shell.tables().quadrature;
  assembly::RowMatrix k = assembly::RowMatrix::Zero(basis.value.cols(), basis.value.cols());
  for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
    const assembly::QuadraturePoint& p = shell.point(cell, q);
    Eigen::Matrix2Xd g(2, basis.value.cols());
    g << basis.d1.row(q), basis.d2.row(q);
    k += p.area / unit_area *
         (basis.value.row(q).transpose() * basis.value.row(q) / unit_area + g.transpose() * p.frame.metric_con * g);
  }
  return k;
}

/// Cartesian element matrix, 6 values a node, for values interpolated in moving bases (M15): field by field.
assembly::RowMatrix covariant_element(const assembly::ShellOperator& shell, std::size_t cell, double length) {
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
    const assembly::QuadraturePoint& p = shell.point(cell, q);
    const double area = p.area / (length * length);
    const Eigen::Matrix2d root = (area * p.frame.metric_con).llt().matrixU();
    value.middleRows<6>(6 * q) *= std::sqrt(area) / length;
    d1.middleRows<6>(6 * q) = (root(0, 0) * d1.middleRows<6>(6 * q) + root(0, 1) * d2.middleRows<6>(6 * q)).eval();
    d2.middleRows<6>(6 * q) *= root(1, 1);
    for (assembly::RowMatrix* rows : {&value, &d1, &d2}) rows->middleRows<3>(6 * q + 3) *= length;
  }
  return value.transpose() * value + d1.transpose() * d1 + d2.transpose() * d2;
}

/// T_i' K_ij T_j for the blocks K_ij of a Cartesian element matrix.
template <class Block>
assembly::RowMatrix in_coordinates(const assembly::NodalCoordinates& coordinates,
                                   std::span<const algebra::LocalIndex> nodes, const Block& block) {
  const int width = coordinates.width;
  const auto n = static_cast<Eigen::Index>(nodes.size());
  const auto basis = [&](Eigen::Index i) {
    return coordinates.basis[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])].leftCols(width);
  };
  assembly::RowMatrix k(width * n, width * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      k.block(width * i, width * j, width, width) = basis(i).transpose() * (block(i, j) * basis(j));
  return k;
}

/// On a cell with tied nodes: W' K W first, by components.
assembly::RowMatrix tied_element(const assembly::NodalCoordinates& coordinates, const fem::Carriers& carriers,
                                 const assembly::RowMatrix& cartesian) {
  const Eigen::Index n = carriers.weights.rows(), m = carriers.weights.cols();
  assembly::RowMatrix W = assembly::RowMatrix::Zero(6 * n, 6 * m);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < m; ++j) W.block<6, 6>(6 * i, 6 * j).diagonal().setConstant(carriers.weights(i, j));
  const assembly::RowMatrix on_carriers = W.transpose() * cartesian * W;
  return in_coordinates(coordinates, carriers.nodes, [&](Eigen::Index i, Eigen::Index j) -> Matrix6 {
    return on_carriers.block<6, 6>(6 * i, 6 * j);
  });
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

algebra::Matrix h1_matrix(const assembly::ShellOperator& shell, const assembly::NodalCoordinates& coordinates,
                          double length) {
  const double weight_of_s = length * length;
  const Vector6 weights = (Vector6() << 1, 1, 1, weight_of_s, weight_of_s, weight_of_s).finished();
  const fem::Space& space = shell.space();
  algebra::Matrix matrix(space.layout, coordinates.width, fem::coupled_nodes(space));
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const auto carriers = fem::carriers(space, c);
    const std::span<const algebra::LocalIndex> nodes = carriers ? std::span(carriers->nodes) : space.nodes(c);
    assembly::RowMatrix k;
    if (shell.quadrature_bases(c).empty()) {
      const assembly::RowMatrix scalar = scalar_element(shell, c, length);
      k = carriers ? tied_element(coordinates, *carriers, by_components(scalar, weights))
                   : in_coordinates(coordinates, nodes, [&](Eigen::Index i, Eigen::Index j) -> Matrix6 {
                       return (scalar(i, j) * weights).asDiagonal();
                     });
    } else {
      const assembly::RowMatrix cartesian = covariant_element(shell, c, length);
      k = carriers ? tied_element(coordinates, *carriers, cartesian)
                   : in_coordinates(coordinates, nodes, [&](Eigen::Index i, Eigen::Index j) -> Matrix6 {
                       return cartesian.block<6, 6>(6 * i, 6 * j);
                     });
    }
    matrix.add(nodes, {k.data(), static_cast<std::size_t>(k.size())});
  }
  matrix.finish();
  return matrix;
}

algebra::Matrix scalar_h1_matrix(const assembly::ShellOperator& shell, double length) {
  const fem::Space& space = shell.space();
  algebra::Matrix matrix(space.layout, 1, fem::coupled_nodes(space));
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    assembly::RowMatrix k = scalar_element(shell, c, length);
    const auto carriers = fem::carriers(space, c);
    if (carriers) k = (carriers->weights.transpose() * k * carriers->weights).eval();
    matrix.add(carriers ? std::span<const algebra::LocalIndex>(carriers->nodes) : space.nodes(c),
               {k.data(), static_cast<std::size_t>(k.size())});
  }
  matrix.finish();
  return matrix;
}

}  // namespace plastron::spectra

#include <plastron/fem/jacobian_table.hpp>

#include <plastron/fem/cell_map.hpp>

namespace plastron::fem {

namespace {

PlaneJet mapped(Shape shape, int order, const std::vector<Vector2d>& nodes, const Vector2d& xi) {
  return shape == Shape::triangle ? TriangleLagrangeMap{order, nodes}(xi) : LagrangeMap{order, nodes}(xi);
}

}  // namespace

JacobianTable jacobian_table(Shape shape, int order) {
  // For degree one the determinant is linear and has its extremes at the corners.
  const int points = order == 1 ? 1 : 4 * order;
  JacobianTable table{.xi = lattice(shape, points), .value = {}, .d1 = {}, .d2 = {}};
  const auto nodes = static_cast<Eigen::Index>(nodes_per_cell(shape, order));
  const auto rows = static_cast<Eigen::Index>(table.xi.size());
  table.value.resize(rows, nodes);
  table.d1.resize(rows, nodes);
  table.d2.resize(rows, nodes);
  std::vector<Vector2d> unit(static_cast<std::size_t>(nodes), Vector2d::Zero());
  for (Eigen::Index n = 0; n < nodes; ++n) {
    unit[static_cast<std::size_t>(n)] = Vector2d::UnitX();  // the map then equals the n-th polynomial
    for (Eigen::Index p = 0; p < rows; ++p) {
      const PlaneJet f = mapped(shape, order, unit, table.xi[static_cast<std::size_t>(p)]);
      table.value(p, n) = f.value[0];
      table.d1(p, n) = f.d[0][0];
      table.d2(p, n) = f.d[1][0];
    }
    unit[static_cast<std::size_t>(n)] = Vector2d::Zero();
  }
  return table;
}

JacobianRange jacobian_range(const JacobianTable& table, const std::vector<Vector2d>& nodes) {
  constexpr double degenerate = 1e-9;  // sine of the angle between the cell's two directions
  Eigen::MatrixX2d x(static_cast<Eigen::Index>(nodes.size()), 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) x.row(static_cast<Eigen::Index>(i)) = nodes[i] - nodes.front();
  const Eigen::MatrixX2d d1 = table.d1 * x, d2 = table.d2 * x;
  JacobianRange range;
  double sum = 0;
  Eigen::VectorXd sine(d1.rows());
  for (Eigen::Index p = 0; p < d1.rows(); ++p) {
    const double lengths = d1.row(p).norm() * d2.row(p).norm();
    sine[p] = lengths > 0 ? (d1(p, 0) * d2(p, 1) - d1(p, 1) * d2(p, 0)) / lengths : 0;
    sum += sine[p];
    range.is_positive = range.is_positive && sine[p] > degenerate;
    range.is_negative = range.is_negative && sine[p] < -degenerate;
  }
  Eigen::Index worst = 0;
  (sum < 0 ? Eigen::VectorXd(-sine) : sine).minCoeff(&worst);
  range.worst = nodes.front() + (table.value.row(worst) * x).transpose();
  return range;
}

}  // namespace plastron::fem

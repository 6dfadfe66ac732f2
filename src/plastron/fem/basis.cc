#include <plastron/fem/basis.hpp>

#include <deal.II/base/quadrature_lib.h>

namespace plastron::fem {

namespace {

Rule rule_of(const dealii::Quadrature<1>& quadrature) {
  Rule rule;
  for (unsigned int q = 0; q < quadrature.size(); ++q) {
    rule.points.push_back(quadrature.point(q)[0]);
    rule.weights.push_back(quadrature.weight(q));
  }
  return rule;
}

}  // namespace

Rule gauss(int points) { return rule_of(dealii::QGauss<1>(static_cast<unsigned int>(points))); }
Rule gauss_lobatto(int points) { return rule_of(dealii::QGaussLobatto<1>(static_cast<unsigned int>(points))); }

LagrangeValues lagrange(std::span<const double> nodes, double x) {
  const int n = static_cast<int>(nodes.size());
  LagrangeValues l{Eigen::VectorXd::Ones(n), Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  // l_i is a product of linear factors (x - x_j) / (x_i - x_j): they are multiplied one by one with the product rule.
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (j == i) continue;
      const double slope = 1 / (nodes[i] - nodes[j]);
      const double factor = (x - nodes[j]) * slope;
      l.dd[i] = l.dd[i] * factor + 2 * l.d[i] * slope;
      l.d[i] = l.d[i] * factor + l.value[i] * slope;
      l.value[i] *= factor;
    }
  return l;
}

LagrangeTable lagrange_table(std::span<const double> nodes, std::span<const double> points) {
  const auto rows = static_cast<Eigen::Index>(points.size()), columns = static_cast<Eigen::Index>(nodes.size());
  LagrangeTable table{Eigen::MatrixXd(rows, columns), Eigen::MatrixXd(rows, columns)};
  for (Eigen::Index p = 0; p < rows; ++p) {
    const LagrangeValues l = lagrange(nodes, points[static_cast<std::size_t>(p)]);
    table.value.row(p) = l.value;
    table.d.row(p) = l.d;
  }
  return table;
}

}  // namespace plastron::fem

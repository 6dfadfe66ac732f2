#include <plastron/mesh/basis.hpp>

#include <deal.II/base/quadrature_lib.h>

namespace plastron::mesh {

namespace {

Rule rule_of(const dealii::Quadrature<1>& quadrature) {
  Rule rule;
  for (unsigned int q = 0; q < quadrature.size(); ++q) {
    rule.points.push_back(quadrature.point(q)[0]);
    rule.weights.push_back(quadrature.weight(q));
  }
  return rule;
}

/// P_i(l) = product over m < i of (n l - m) / (i - m), with two derivatives: 1 at l = i/n, 0 at l = 0, ..., (i-1)/n.
struct Factor {
  double value = 1, d = 0, dd = 0;
};

Factor factor(int n, int i, double l) {
  Factor f;
  for (int m = 0; m < i; ++m) {
    const double slope = static_cast<double>(n) / (i - m), linear = (n * l - m) / (i - m);
    f.dd = f.dd * linear + 2 * f.d * slope;
    f.d = f.d * linear + f.value * slope;
    f.value *= linear;
  }
  return f;
}

/// Adds all permutations of three barycentric coordinates as points of the same weight.
void add_orbit(double a, double b, double c, double weight, TriangleRule& rule) {
  const auto add = [&](double x, double y) {
    rule.points.emplace_back(x, y);
    rule.weights.push_back(weight / 2);
  };
  add(a, b);
  add(b, c);
  add(c, a);
  if (a == b || b == c || c == a) return;
  add(b, a);
  add(c, b);
  add(a, c);
}

void add_orbit(double a, double weight, TriangleRule& rule) { add_orbit(a, a, 1 - 2 * a, weight, rule); }

/// Rule of the square (s, t) -> (s (1 - t), t), whose area element 1 - t costs one degree.
TriangleRule collapsed_rule(int degree) {
  const Rule line = gauss(degree / 2 + 2);
  TriangleRule rule;
  for (std::size_t j = 0; j < line.points.size(); ++j)
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const double s = line.points[i], t = line.points[j];
      rule.points.emplace_back(s * (1 - t), t);
      rule.weights.push_back(line.weights[i] * line.weights[j] * (1 - t));
    }
  return rule;
}

LatticeValues square_values(int order, const Vector2d& xi) {
  std::vector<double> equidistant;
  for (int i = 0; i <= order; ++i) equidistant.push_back(static_cast<double>(i) / order);
  const LagrangeValues p = lagrange(equidistant, xi[0]), q = lagrange(equidistant, xi[1]);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(nodes_per_cell(Shape::quadrilateral, order));
  LatticeValues v{zero, {zero, zero}, {zero, zero, zero}};
  int node = 0;
  for (int j = 0; j <= order; ++j)
    for (int i = 0; i <= order; ++i, ++node) {
      v.value[node] = p.value[i] * q.value[j];
      v.d[0][node] = p.d[i] * q.value[j];
      v.d[1][node] = p.value[i] * q.d[j];
      v.dd[0][node] = p.dd[i] * q.value[j];
      v.dd[1][node] = p.d[i] * q.d[j];
      v.dd[2][node] = p.value[i] * q.dd[j];
    }
  return v;
}

LatticeValues triangle_values(int order, const Vector2d& xi) {
  const int count = nodes_per_cell(Shape::triangle, order);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(count);
  LatticeValues v{zero, {zero, zero}, {zero, zero, zero}};
  int node = 0;
  for (int j = 0; j <= order; ++j)
    for (int i = 0; i <= order - j; ++i, ++node) {
      // Product of functions P, Q, R of the barycentric coordinates l_0 = 1 - xi_1 - xi_2, xi_1, xi_2.
      const Factor p = factor(order, order - i - j, 1 - xi[0] - xi[1]), q = factor(order, i, xi[0]),
                   r = factor(order, j, xi[1]);
      v.value[node] = p.value * q.value * r.value;
      v.d[0][node] = (p.value * q.d - p.d * q.value) * r.value;
      v.d[1][node] = (p.value * r.d - p.d * r.value) * q.value;
      v.dd[0][node] = (p.value * q.dd - 2 * p.d * q.d + p.dd * q.value) * r.value;
      v.dd[1][node] = p.value * q.d * r.d - p.d * (q.d * r.value + q.value * r.d) + p.dd * q.value * r.value;
      v.dd[2][node] = (p.value * r.dd - 2 * p.d * r.d + p.dd * r.value) * q.value;
    }
  return v;
}

}  // namespace

Rule gauss(int points) { return rule_of(dealii::QGauss<1>(static_cast<unsigned int>(points))); }
Rule gauss_lobatto(int points) { return rule_of(dealii::QGaussLobatto<1>(static_cast<unsigned int>(points))); }

LagrangeValues lagrange(std::span<const double> nodes, double x) {
  const int n = static_cast<int>(nodes.size());
  using Vector = LagrangeValues::Vector;
  LagrangeValues l{Vector::Ones(n), Vector::Zero(n), Vector::Zero(n)};
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
    const LagrangeValues l = lagrange(nodes, points[p]);
    table.value.row(p) = l.value;
    table.d.row(p) = l.d;
  }
  return table;
}

LatticeValues lattice_values(Shape shape, int order, const Vector2d& xi) {
  return shape == Shape::triangle ? triangle_values(order, xi) : square_values(order, xi);
}

LatticeTable lattice_table(Shape shape, int order, std::vector<Vector2d> xi) {
  const auto rows = static_cast<Eigen::Index>(xi.size());
  const auto columns = static_cast<Eigen::Index>(nodes_per_cell(shape, order));
  LatticeTable table{.xi = std::move(xi), .value = {}, .d1 = {}, .d2 = {}};
  for (Eigen::MatrixXd* m : {&table.value, &table.d1, &table.d2}) m->resize(rows, columns);
  for (Eigen::Index p = 0; p < rows; ++p) {
    const LatticeValues v = lattice_values(shape, order, table.xi[static_cast<std::size_t>(p)]);
    table.value.row(p) = v.value;
    table.d1.row(p) = v.d[0];
    table.d2.row(p) = v.d[1];
  }
  return table;
}

std::vector<Vector2d> node_points(Shape shape, int degree) {
  if (shape == Shape::triangle) return lattice(shape, degree);
  const std::vector<double> line = gauss_lobatto(degree + 1).points;
  std::vector<Vector2d> points;
  for (const double t : line)
    for (const double s : line) points.emplace_back(s, t);
  return points;
}

TriangleRule triangle_rule(int degree) {
  TriangleRule rule;
  switch (degree) {
    case 1:
      return {{centre(Shape::triangle)}, {0.5}};
    case 2:
      add_orbit(1.0 / 6, 1.0 / 3, rule);
      return rule;
    case 4:
      add_orbit(0.44594849091596488632, 0.22338158967801146570, rule);
      add_orbit(0.09157621350977074346, 0.10995174365532186764, rule);
      return rule;
    case 6:
      add_orbit(0.24928674517091042129, 0.11678627572637936603, rule);
      add_orbit(0.06308901449150222734, 0.05084490637020681692, rule);
      add_orbit(0.05314504984481694735, 0.31035245103378440542, 1 - 0.05314504984481694735 - 0.31035245103378440542,
                0.08285107561837357519, rule);
      return rule;
    default:
      return collapsed_rule(degree);
  }
}

}  // namespace plastron::mesh

#include <plastron/element/element_tables.hpp>

#include <Eigen/LU>

#include <cmath>

namespace plastron::element {

namespace {

using mesh::Rule;
using mesh::Shape;

std::vector<Vector2d> grid(const std::vector<double>& along_1, const std::vector<double>& along_2) {
  std::vector<Vector2d> points;
  for (const double b : along_2)
    for (const double a : along_1) points.emplace_back(a, b);
  return points;
}

struct SamplingLines {
  std::vector<double> along_1, along_2;
};

/// Gauss points of the three groups of (M22).
std::vector<SamplingLines> sampling_lines(int degree) {
  const auto full = mesh::gauss(degree + 1).points, reduced = mesh::gauss(degree).points;
  return {{reduced, full}, {full, reduced}, {reduced, reduced}};
}

std::vector<std::vector<std::pair<int, double>>> nonzeros(const MatrixXd& interpolation) {
  std::vector<std::vector<std::pair<int, double>>> rows(static_cast<std::size_t>(interpolation.rows()));
  for (Eigen::Index q = 0; q < interpolation.rows(); ++q)
    for (Eigen::Index t = 0; t < interpolation.cols(); ++t)
      if (std::abs(interpolation(q, t)) > 1e-13) rows[q].emplace_back(static_cast<int>(t), interpolation(q, t));
  return rows;
}

/// Tensor products of Lagrange polynomials at points, with xi_1 running fastest.
MatrixXd tensor_interpolation(const SamplingLines& lines, const std::vector<Vector2d>& xi) {
  const auto n1 = static_cast<Eigen::Index>(lines.along_1.size()), n2 = static_cast<Eigen::Index>(lines.along_2.size());
  MatrixXd interpolation(static_cast<Eigen::Index>(xi.size()), n1 * n2);
  for (Eigen::Index p = 0; p < interpolation.rows(); ++p) {
    const auto a = mesh::lagrange(lines.along_1, xi[p][0]).value;
    const auto b = mesh::lagrange(lines.along_2, xi[p][1]).value;
    for (Eigen::Index j = 0; j < n2; ++j)
      for (Eigen::Index i = 0; i < n1; ++i) interpolation(p, j * n1 + i) = a[i] * b[j];
  }
  return interpolation;
}

BasisAt square_basis(int degree, const std::vector<Vector2d>& xi) {
  const auto nodes = mesh::gauss_lobatto(degree + 1).points;
  const int n = degree + 1;
  const auto points = static_cast<Eigen::Index>(xi.size());
  BasisAt basis{xi, MatrixXd(points, n * n), MatrixXd(points, n * n), MatrixXd(points, n * n)};
  for (Eigen::Index p = 0; p < points; ++p) {
    const auto a = mesh::lagrange(nodes, xi[p][0]);
    const auto b = mesh::lagrange(nodes, xi[p][1]);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        basis.value(p, j * n + i) = a.value[i] * b.value[j];
        basis.d1(p, j * n + i) = a.d[i] * b.value[j];
        basis.d2(p, j * n + i) = a.value[i] * b.d[j];
      }
  }
  return basis;
}

BasisAt triangle_basis(int degree, const std::vector<Vector2d>& xi) {
  mesh::LatticeTable table = mesh::lattice_table(Shape::triangle, degree, xi);
  return {std::move(table.xi), std::move(table.value), std::move(table.d1), std::move(table.d2)};
}

/// Samples every strain at the quadrature points themselves.
void sample_at_quadrature(ElementTables& tables) {
  const auto points = static_cast<Eigen::Index>(tables.quadrature.xi.size());
  tables.samplings.push_back({.basis = tables.quadrature,
                              .membrane = {0, 1, 2},
                              .shear = {0, 1},
                              .to_quadrature = nonzeros(MatrixXd::Identity(points, points))});
}

void tie(ElementTables& tables) {
  const auto interpolation = tied_interpolation(tables, tables.quadrature.xi);
  const auto lines = sampling_lines(tables.degree);
  for (std::size_t s = 0; s < lines.size(); ++s)
    tables.samplings.push_back(
        {square_basis(tables.degree, grid(lines[s].along_1, lines[s].along_2)), {}, {}, nonzeros(interpolation[s])});
  tables.samplings[static_cast<int>(TiedGroup::along_1)].membrane = {0};
  tables.samplings[static_cast<int>(TiedGroup::along_1)].shear = {0};
  tables.samplings[static_cast<int>(TiedGroup::along_2)].membrane = {1};
  tables.samplings[static_cast<int>(TiedGroup::along_2)].shear = {1};
  tables.samplings[static_cast<int>(TiedGroup::mixed)].membrane = {2};
}

ElementTables square_tables(int degree, bool tying) {
  const Rule gauss = mesh::gauss(degree + 1), lobatto = mesh::gauss_lobatto(degree + 1);
  ElementTables tables{.shape = Shape::quadrilateral,
                       .degree = degree,
                       .tying = tying,
                       .quadrature = square_basis(degree, grid(gauss.points, gauss.points)),
                       .weights = {},
                       .samplings = {},
                       .nodes = grid(lobatto.points, lobatto.points),
                       .nodal_weights = {}};
  for (const double b : gauss.weights)
    for (const double a : gauss.weights) tables.weights.push_back(a * b);
  for (const double b : lobatto.weights)
    for (const double a : lobatto.weights) tables.nodal_weights.push_back(a * b);
  return tables;
}

ElementTables triangle_tables(int degree) {
  const mesh::TriangleRule rule = mesh::triangle_rule(2 * degree + 2);
  const double third = 1.0 / 6;  // third of the reference triangle's area
  return {.shape = Shape::triangle,
          .degree = degree,
          .tying = false,
          .quadrature = triangle_basis(degree, rule.points),
          .weights = rule.weights,
          .samplings = {},
          .nodes = mesh::lattice(Shape::triangle, degree),
          .nodal_weights =
              degree == 1 ? std::vector{third, third, third} : std::vector{0.0, third, 0.0, third, third, 0.0}};
}

/// Interpolates linearly between values at three points: a row per point of `xi`, a column per given value.
MatrixXd linear_interpolation(const std::vector<Vector2d>& from, const std::vector<Vector2d>& xi) {
  const auto vandermonde = [](const std::vector<Vector2d>& points) {
    MatrixXd v(static_cast<Eigen::Index>(points.size()), 3);
    for (Eigen::Index p = 0; p < v.rows(); ++p) v.row(p) << 1, points[p].transpose();
    return v;
  };
  return vandermonde(xi) * vandermonde(from).inverse();
}

}  // namespace

BasisAt basis_at(Shape shape, int degree, const std::vector<Vector2d>& xi) {
  return shape == Shape::triangle ? triangle_basis(degree, xi) : square_basis(degree, xi);
}

MatrixXd reaction_basis_at(Shape shape, int degree, const std::vector<Vector2d>& xi) {
  if (shape == Shape::quadrilateral || degree == 1) return basis_at(shape, degree, xi).value;
  const auto nodes = mesh::lattice(shape, degree);
  constexpr Eigen::Index middles[3] = {1, 3, 4};
  const MatrixXd linear = linear_interpolation({nodes[1], nodes[3], nodes[4]}, xi);
  MatrixXd basis = MatrixXd::Zero(static_cast<Eigen::Index>(xi.size()), static_cast<Eigen::Index>(nodes.size()));
  for (Eigen::Index k = 0; k < 3; ++k) basis.col(middles[k]) = linear.col(k);
  return basis;
}

std::vector<Vector2d> resultant_points(Shape shape, int degree) {
  if (shape == Shape::triangle) return mesh::triangle_rule(degree).points;
  const auto line = mesh::gauss(degree).points;
  return grid(line, line);
}

MatrixXd resultant_continuation(Shape shape, int degree, const std::vector<Vector2d>& xi) {
  if (shape == Shape::triangle)
    return degree == 1 ? MatrixXd::Ones(static_cast<Eigen::Index>(xi.size()), 1)
                       : linear_interpolation(resultant_points(shape, degree), xi);
  const auto line = mesh::gauss(degree).points;
  return tensor_interpolation({line, line}, xi);
}

std::vector<MatrixXd> tied_interpolation(const ElementTables& tables, const std::vector<Vector2d>& xi) {
  std::vector<MatrixXd> all;
  if (!tables.tying) return all;
  for (const SamplingLines& lines : sampling_lines(tables.degree)) all.push_back(tensor_interpolation(lines, xi));
  return all;
}

ElementTables element_tables(Shape shape, int degree, bool tying) {
  ElementTables tables = shape == Shape::triangle ? triangle_tables(degree) : square_tables(degree, tying);
  if (tables.tying)
    tie(tables);
  else
    sample_at_quadrature(tables);
  return tables;
}

LineTables line_tables(int degree) {
  const auto nodes = mesh::gauss_lobatto(degree + 1).points;
  const auto full = mesh::gauss(degree + 1).points, reduced = mesh::gauss(degree).points;
  return {.full = mesh::lagrange_table(nodes, full),
          .reduced = mesh::lagrange_table(nodes, reduced),
          .from_reduced = mesh::lagrange_table(reduced, full).value};
}

}  // namespace plastron::element

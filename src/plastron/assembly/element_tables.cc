#include <plastron/assembly/element_tables.hpp>

#include <plastron/fem/basis.hpp>

#include <cmath>

namespace plastron::assembly {

namespace {

using fem::Rule;

std::vector<Vector2d> grid(const std::vector<double>& along_1, const std::vector<double>& along_2) {
  std::vector<Vector2d> points;
  for (const double b : along_2)
    for (const double a : along_1) points.emplace_back(a, b);
  return points;
}

struct SamplingLines {
  std::vector<double> along_1, along_2;
};

/// Gauss points of the three groups of (M22); all of them the quadrature points without tying.
std::vector<SamplingLines> sampling_lines(int degree, bool tying) {
  const auto full = fem::gauss(degree + 1).points;
  if (!tying) return {{full, full}};
  const auto reduced = fem::gauss(degree).points;
  return {{reduced, full}, {full, reduced}, {reduced, reduced}};
}

std::vector<std::vector<std::pair<int, double>>> nonzeros(const MatrixXd& interpolation) {
  std::vector<std::vector<std::pair<int, double>>> rows(static_cast<std::size_t>(interpolation.rows()));
  for (Eigen::Index q = 0; q < interpolation.rows(); ++q)
    for (Eigen::Index t = 0; t < interpolation.cols(); ++t)
      if (std::abs(interpolation(q, t)) > 1e-13)
        rows[static_cast<std::size_t>(q)].emplace_back(static_cast<int>(t), interpolation(q, t));
  return rows;
}

}  // namespace

BasisAt basis_at(int degree, const std::vector<Vector2d>& xi) {
  const auto nodes = fem::gauss_lobatto(degree + 1).points;
  const int n = degree + 1;
  const auto points = static_cast<Eigen::Index>(xi.size());
  BasisAt basis{xi, MatrixXd(points, n * n), MatrixXd(points, n * n), MatrixXd(points, n * n)};
  for (Eigen::Index p = 0; p < points; ++p) {
    const auto a = fem::lagrange(nodes, xi[static_cast<std::size_t>(p)][0]);
    const auto b = fem::lagrange(nodes, xi[static_cast<std::size_t>(p)][1]);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        basis.value(p, j * n + i) = a.value[i] * b.value[j];
        basis.d1(p, j * n + i) = a.d[i] * b.value[j];
        basis.d2(p, j * n + i) = a.value[i] * b.d[j];
      }
  }
  return basis;
}

std::vector<MatrixXd> tied_interpolation(const ElementTables& tables, const std::vector<Vector2d>& xi) {
  std::vector<MatrixXd> all;
  for (const SamplingLines& lines : sampling_lines(tables.degree, tables.tying)) {
    const auto n1 = static_cast<Eigen::Index>(lines.along_1.size()),
               n2 = static_cast<Eigen::Index>(lines.along_2.size());
    MatrixXd interpolation(static_cast<Eigen::Index>(xi.size()), n1 * n2);
    for (Eigen::Index p = 0; p < interpolation.rows(); ++p) {
      const auto a = fem::lagrange(lines.along_1, xi[static_cast<std::size_t>(p)][0]).value;
      const auto b = fem::lagrange(lines.along_2, xi[static_cast<std::size_t>(p)][1]).value;
      for (Eigen::Index j = 0; j < n2; ++j)
        for (Eigen::Index i = 0; i < n1; ++i) interpolation(p, j * n1 + i) = a[i] * b[j];
    }
    all.push_back(std::move(interpolation));
  }
  return all;
}

ElementTables element_tables(int degree, bool tying) {
  const Rule gauss = fem::gauss(degree + 1), lobatto = fem::gauss_lobatto(degree + 1);
  ElementTables tables{.degree = degree,
                       .tying = tying,
                       .quadrature = basis_at(degree, grid(gauss.points, gauss.points)),
                       .weights = {},
                       .samplings = {},
                       .nodes = grid(lobatto.points, lobatto.points),
                       .nodal_weights = {}};
  for (const double b : gauss.weights)
    for (const double a : gauss.weights) tables.weights.push_back(a * b);
  for (const double b : lobatto.weights)
    for (const double a : lobatto.weights) tables.nodal_weights.push_back(a * b);

  const auto lines = sampling_lines(degree, tying);
  const auto interpolation = tied_interpolation(tables, tables.quadrature.xi);
  for (std::size_t s = 0; s < lines.size(); ++s)
    tables.samplings.push_back(
        {basis_at(degree, grid(lines[s].along_1, lines[s].along_2)), {}, {}, nonzeros(interpolation[s])});
  if (tying) {
    tables.samplings[static_cast<int>(TiedGroup::along_1)].membrane = {0};
    tables.samplings[static_cast<int>(TiedGroup::along_1)].shear = {0};
    tables.samplings[static_cast<int>(TiedGroup::along_2)].membrane = {1};
    tables.samplings[static_cast<int>(TiedGroup::along_2)].shear = {1};
    tables.samplings[static_cast<int>(TiedGroup::mixed)].membrane = {2};
  } else {
    tables.samplings[0].membrane = {0, 1, 2};
    tables.samplings[0].shear = {0, 1};
  }
  return tables;
}

}  // namespace plastron::assembly

// The polynomials that each table of the element reproduces, for all degrees: of the basis, the rules, tying (M22), the continuation of
// resultants and the reaction.
#include <plastron/element/element_tables.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/reference_cell.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include "larger.hpp"

namespace plastron::element::exactness_test {
namespace {

using mesh::Shape;

struct Element {
  Shape shape;
  int degree;
};
void PrintTo(const Element& e, std::ostream* out) {
  *out << mesh::corner_count(e.shape) << " corners, degree " << e.degree;
}

std::vector<Element> elements() {
  std::vector<Element> all{{Shape::triangle, 1}, {Shape::triangle, 2}};
  for (int k = 1; k <= 8; ++k) all.push_back({Shape::quadrilateral, k});
  return all;
}

/// (xi_1 - 0.3)^p (xi_2 + 0.2)^q
struct Monomial {
  int p, q;
  double operator()(const Vector2d& xi) const { return std::pow(xi[0] - 0.3, p) * std::pow(xi[1] + 0.2, q); }
  double d1(const Vector2d& xi) const { return p == 0 ? 0 : p * Monomial{p - 1, q}(xi); }
  double d2(const Vector2d& xi) const { return q == 0 ? 0 : q * Monomial{p, q - 1}(xi); }
};

/// Monomials up to the degrees p and q on squares, and up to the sum of degrees p on triangles.
std::vector<Monomial> monomials(Shape shape, int p_most, int q_most) {
  std::vector<Monomial> all;
  for (int p = 0; p <= p_most; ++p)
    for (int q = 0; q <= q_most; ++q)
      if (shape == Shape::quadrilateral || p + q <= p_most) all.push_back({p, q});
  return all;
}

/// Points of the reference cell: random ones, the centre and the corners.
std::vector<Vector2d> probes(Shape shape) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Vector2d> all{mesh::centre(shape)};
  for (int k = 0; k < mesh::corner_count(shape); ++k) all.push_back(mesh::corner(shape, k));
  while (all.size() < 12) {
    const Vector2d xi(coordinate(random), coordinate(random));
    if (mesh::holds(shape, xi, 0)) all.push_back(xi);
  }
  return all;
}

Eigen::VectorXd values_at(const std::vector<Vector2d>& points, const std::function<double(const Vector2d&)>& f) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) values[static_cast<Eigen::Index>(i)] = f(points[i]);
  return values;
}

/// Largest difference between `table` times the values of f at `from`, and the values of f at `to`.
double miss(const MatrixXd& table, const std::vector<Vector2d>& from, const std::vector<Vector2d>& to,
            const Monomial& f) {
  return (table * values_at(from, f) - values_at(to, f)).lpNorm<Eigen::Infinity>();
}

double integral(const std::vector<double>& weights, const std::vector<Vector2d>& points, const Monomial& f) {
  return Eigen::Map<const Eigen::VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size()))
      .dot(values_at(points, f));
}

/// The integral over the reference cell, with a rule of more points than any table.
double exact_integral(Shape shape, const Monomial& f) {
  if (shape == Shape::triangle) {
    const mesh::TriangleRule rule = mesh::triangle_rule(9);
    return integral(rule.weights, rule.points, f);
  }
  const auto antiderivative = [](double x, int n) { return std::pow(x, n + 1) / (n + 1); };
  return (antiderivative(0.7, f.p) - antiderivative(-0.3, f.p)) * (antiderivative(1.2, f.q) - antiderivative(0.2, f.q));
}

class Exactness : public testing::TestWithParam<Element> {};
INSTANTIATE_TEST_SUITE_P(Each, Exactness, testing::ValuesIn(elements()));

TEST_P(Exactness, OfTheBasisAndItsDerivativesIsItsDegree) {
  const auto [shape, k] = GetParam();
  const ElementTables t = element_tables(shape, k, true);
  const auto at = probes(shape);
  const BasisAt basis = basis_at(shape, k, at);
  ASSERT_EQ(basis.value.cols(), t.nodes_per_cell());
  for (const Monomial& f : monomials(shape, k, k)) {
    EXPECT_LT(miss(basis.value, t.nodes, at, f), 1e-13) << f.p << ' ' << f.q;
    const Eigen::VectorXd nodal = values_at(t.nodes, f);
    EXPECT_LT((basis.d1 * nodal - values_at(at, [&](const Vector2d& xi) { return f.d1(xi); })).cwiseAbs().maxCoeff(),
              1e-11);
    EXPECT_LT((basis.d2 * nodal - values_at(at, [&](const Vector2d& xi) { return f.d2(xi); })).cwiseAbs().maxCoeff(),
              1e-11);
  }
  EXPECT_GT(miss(basis.value, t.nodes, at, {k + 1, 0}), 1e-6);  // no higher degree
}

TEST_P(Exactness, OfEachBasisFunctionIsOneAtItsNodeAndZeroAtOthers) {
  const auto [shape, k] = GetParam();
  const auto nodes = element_tables(shape, k, false).nodes;
  const MatrixXd at_nodes = basis_at(shape, k, nodes).value;
  EXPECT_LT((at_nodes - MatrixXd::Identity(at_nodes.rows(), at_nodes.cols())).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_P(Exactness, OfTheBasisKeepsItsSumOne) {
  const auto [shape, k] = GetParam();
  const BasisAt basis = basis_at(shape, k, probes(shape));
  for (Eigen::Index p = 0; p < basis.value.rows(); ++p) {
    EXPECT_NEAR(basis.value.row(p).sum(), 1, 1e-13);
    EXPECT_NEAR(basis.d1.row(p).sum(), 0, 1e-11);
    EXPECT_NEAR(basis.d2.row(p).sum(), 0, 1e-11);
  }
}

TEST_P(Exactness, OfDerivativesIsThatOfDifferences) {
  const auto [shape, k] = GetParam();
  constexpr double step = 1e-5;
  const auto at = probes(shape);
  const BasisAt basis = basis_at(shape, k, at);
  for (int direction = 0; direction < 2; ++direction) {
    auto ahead = at, behind = at;
    for (Vector2d& xi : ahead) xi[direction] += step;
    for (Vector2d& xi : behind) xi[direction] -= step;
    const MatrixXd difference = (basis_at(shape, k, ahead).value - basis_at(shape, k, behind).value) / (2 * step);
    // The third derivative of a polynomial of degree k is at most about k^6 / 15 times its size (Markov, on an interval of length 1: 8 times).
    const double curved = std::pow(k, 6) * step * step + 1e-9;
    EXPECT_LT((difference - (direction == 0 ? basis.d1 : basis.d2)).cwiseAbs().maxCoeff(), curved);
  }
}

TEST_P(Exactness, OfTheQuadratureIsTwiceTheDegreeAndMore) {
  const auto [shape, k] = GetParam();
  const ElementTables t = element_tables(shape, k, false);
  const int exact = shape == Shape::triangle ? 2 * k + 2 : 2 * k + 1;
  for (const Monomial& f : monomials(shape, exact, exact))
    EXPECT_NEAR(integral(t.weights, t.quadrature.xi, f), exact_integral(shape, f), 1e-13) << f.p << ' ' << f.q;
}

// (M21)
TEST_P(Exactness, OfTheNodalQuadratureIsThatOfGaussAndLobatto) {
  const auto [shape, k] = GetParam();
  const ElementTables t = element_tables(shape, k, false);
  const int exact = shape == Shape::triangle ? k : 2 * k - 1;
  for (const Monomial& f : monomials(shape, exact, exact))
    EXPECT_NEAR(integral(t.nodal_weights, t.nodes, f), exact_integral(shape, f), 1e-13) << f.p << ' ' << f.q;
  EXPECT_GT(std::abs(integral(t.nodal_weights, t.nodes, {exact + 1, 0}) - exact_integral(shape, {exact + 1, 0})),
            1e-12);
}

TEST_P(Exactness, OfTheContinuationOfResultantsIsOneDegreeLower) {
  const auto [shape, k] = GetParam();
  const auto from = resultant_points(shape, k), at = probes(shape);
  const MatrixXd continuation = resultant_continuation(shape, k, at);
  ASSERT_EQ(continuation.cols(), static_cast<Eigen::Index>(from.size()));
  for (const Monomial& f : monomials(shape, k - 1, k - 1))
    EXPECT_LT(miss(continuation, from, at, f), 1e-12) << f.p << ' ' << f.q;
  EXPECT_GT(miss(continuation, from, at, {k, 0}), 1e-6);
}

// On triangles of degree 2 the reaction is linear, and vertices do not matter.
TEST_P(Exactness, OfTheReactionIsTheDegreeOrOneOnTriangles) {
  const auto [shape, k] = GetParam();
  const ElementTables t = element_tables(shape, k, false);
  const auto at = probes(shape);
  const MatrixXd reaction = reaction_basis_at(shape, k, at);
  ASSERT_EQ(reaction.cols(), t.nodes_per_cell());
  const int exact = shape == Shape::triangle ? 1 : k;
  for (const Monomial& f : monomials(shape, exact, exact)) EXPECT_LT(miss(reaction, t.nodes, at, f), 1e-13);
  for (Eigen::Index i = 0; i < reaction.cols(); ++i)
    EXPECT_EQ(reaction.col(i).isZero(0), t.nodal_weights[static_cast<std::size_t>(i)] == 0) << i;
}

TEST_P(Exactness, OfTheIntegralOfTheReactionIsThatOfTheNodalQuadrature) {
  const auto [shape, k] = GetParam();
  const ElementTables t = element_tables(shape, k, false);
  const MatrixXd reaction = reaction_basis_at(shape, k, t.quadrature.xi);
  const Eigen::Map<const Eigen::RowVectorXd> weights(t.weights.data(), static_cast<Eigen::Index>(t.weights.size()));
  const Eigen::RowVectorXd integrals = weights * reaction;
  for (std::size_t i = 0; i < t.nodal_weights.size(); ++i)
    EXPECT_NEAR(integrals[static_cast<Eigen::Index>(i)], t.nodal_weights[i], 1e-14);
}

class Tying : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(OfEachDegree, Tying, testing::Range(1, 9));

/// `to_quadrature` as a matrix.
MatrixXd matrix_of(const Sampling& sampling) {
  MatrixXd m = MatrixXd::Zero(static_cast<Eigen::Index>(sampling.to_quadrature.size()),
                              static_cast<Eigen::Index>(sampling.basis.xi.size()));
  for (std::size_t q = 0; q < sampling.to_quadrature.size(); ++q)
    for (const auto& [point, weight] : sampling.to_quadrature[q]) m(static_cast<Eigen::Index>(q), point) += weight;
  return m;
}

// (M22)
TEST_P(Tying, IsExactInTheWholeCellOneDegreeLowerAlongTheStrain) {
  const int k = GetParam();
  const ElementTables t = element_tables(Shape::quadrilateral, k, true);
  const auto at = probes(Shape::quadrilateral);
  const auto anywhere = tied_interpolation(t, at);
  const int most[3][2] = {{k - 1, k}, {k, k - 1}, {k - 1, k - 1}};
  ASSERT_EQ(t.samplings.size(), 3U);
  for (std::size_t s = 0; s < 3; ++s) {
    const auto& from = t.samplings[s].basis.xi;
    for (const Monomial& f : monomials(Shape::quadrilateral, most[s][0], most[s][1])) {
      EXPECT_LT(miss(anywhere[s], from, at, f), 1e-12) << s << ": " << f.p << ' ' << f.q;
      EXPECT_LT(miss(matrix_of(t.samplings[s]), from, t.quadrature.xi, f), 1e-12) << s << ": " << f.p << ' ' << f.q;
    }
    EXPECT_GT(miss(anywhere[s], from, at, {most[s][0] + 1, 0}), 1e-7);
    EXPECT_GT(miss(anywhere[s], from, at, {0, most[s][1] + 1}), 1e-7);
  }
}

// d_1 of the basis has degree k - 1 along xi_1 and k along xi_2. So tying does not change gamma_11 in a plane.
TEST_P(Tying, ChangesNoDerivativeAlongItsStrain) {
  const ElementTables t = element_tables(Shape::quadrilateral, GetParam(), true);
  const Sampling &along_1 = t.samplings[static_cast<std::size_t>(TiedGroup::along_1)],
                 &along_2 = t.samplings[static_cast<std::size_t>(TiedGroup::along_2)];
  EXPECT_LT((matrix_of(along_1) * along_1.basis.d1 - t.quadrature.d1).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((matrix_of(along_2) * along_2.basis.d2 - t.quadrature.d2).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_GT((matrix_of(along_1) * along_1.basis.value - t.quadrature.value).cwiseAbs().maxCoeff(), 1e-3);
}

TEST_P(Tying, SamplesEachStrainOnce) {
  const ElementTables t = element_tables(Shape::quadrilateral, GetParam(), true);
  std::vector<int> membrane(3, 0), shear(2, 0);
  for (const Sampling& s : t.samplings) {
    for (const int c : s.membrane) ++membrane[static_cast<std::size_t>(c)];
    for (const int c : s.shear) ++shear[static_cast<std::size_t>(c)];
  }
  EXPECT_EQ(membrane, (std::vector{1, 1, 1}));
  EXPECT_EQ(shear, (std::vector{1, 1}));
}

/// The tensor product of two tables along lines, with xi_1 fastest.
MatrixXd product(const MatrixXd& along_1, const MatrixXd& along_2) {
  MatrixXd all(along_1.rows() * along_2.rows(), along_1.cols() * along_2.cols());
  for (Eigen::Index j = 0; j < along_2.rows(); ++j)
    for (Eigen::Index l = 0; l < along_2.cols(); ++l)
      all.block(j * along_1.rows(), l * along_1.cols(), along_1.rows(), along_1.cols()) = along_2(j, l) * along_1;
  return all;
}

TEST_P(Tying, IsTheProductOfTheTablesOfLines) {
  const ElementTables t = element_tables(Shape::quadrilateral, GetParam(), true);
  const LineTables line = line_tables(GetParam());
  const MatrixXd one = MatrixXd::Identity(line.full.value.rows(), line.full.value.rows());
  const auto off = [](const MatrixXd& a, const MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff(); };
  EXPECT_LT(off(product(line.full.d, line.full.value), t.quadrature.d1), 1e-12);
  EXPECT_LT(off(product(line.full.value, line.full.d), t.quadrature.d2), 1e-12);
  EXPECT_LT(off(product(line.reduced.d, line.full.value), t.samplings[0].basis.d1), 1e-12);
  EXPECT_LT(off(product(line.full.value, line.reduced.d), t.samplings[1].basis.d2), 1e-12);
  EXPECT_LT(off(product(line.reduced.value, line.reduced.value), t.samplings[2].basis.value), 1e-13);
  EXPECT_LT(off(product(line.from_reduced, one), matrix_of(t.samplings[0])), 1e-12);
  EXPECT_LT(off(product(one, line.from_reduced), matrix_of(t.samplings[1])), 1e-12);
  EXPECT_LT(off(product(line.from_reduced, line.from_reduced), matrix_of(t.samplings[2])), 1e-12);
}

}  // namespace
}  // namespace plastron::element::exactness_test

#include <plastron/element/element_tables.hpp>
#include <plastron/mesh/basis.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace plastron::element {
namespace {

using mesh::Shape;

TEST(ElementTables, TheWeightsSumToTheUnitSquare) {
  for (int degree = 1; degree <= 8; ++degree) {
    const ElementTables t = element_tables(Shape::quadrilateral, degree, true);
    EXPECT_NEAR(std::accumulate(t.weights.begin(), t.weights.end(), 0.0), 1, 1e-14);
    EXPECT_NEAR(std::accumulate(t.nodal_weights.begin(), t.nodal_weights.end(), 0.0), 1, 1e-14);
    for (const double w : t.nodal_weights) EXPECT_GT(w, 0);
  }
}

// (M22)
TEST(ElementTables, TyingUsesTheGaussPointsOfM22) {
  for (int k = 1; k <= 8; ++k) {
    const ElementTables t = element_tables(Shape::quadrilateral, k, true);
    ASSERT_EQ(t.samplings.size(), 3u);
    EXPECT_EQ(t.samplings[0].basis.xi.size(), static_cast<std::size_t>(k * (k + 1)));
    EXPECT_EQ(t.samplings[1].basis.xi.size(), static_cast<std::size_t>(k * (k + 1)));
    EXPECT_EQ(t.samplings[2].basis.xi.size(), static_cast<std::size_t>(k * k));
  }
}

// gamma_11 is tied to degree k - 1 along xi_1 and degree k along xi_2; gamma_12 to k - 1 both ways.
TEST(ElementTables, TiedInterpolationReproducesThePolynomialsItShould) {
  for (int k = 1; k <= 5; ++k) {
    const ElementTables t = element_tables(Shape::quadrilateral, k, true);
    const std::vector<Eigen::Vector2d> at{{0.13, 0.71}, {0.97, 0.02}};
    const auto interpolation = tied_interpolation(t, at);
    const int highest[3][2] = {{k - 1, k}, {k, k - 1}, {k - 1, k - 1}};
    for (std::size_t s = 0; s < t.samplings.size(); ++s) {
      const int p = highest[s][0], q = highest[s][1];
      const auto f = [&](const Eigen::Vector2d& xi) { return std::pow(xi[0] - 0.3, p) * std::pow(xi[1] + 0.2, q); };
      for (std::size_t i = 0; i < at.size(); ++i) {
        double value = 0;
        for (std::size_t j = 0; j < t.samplings[s].basis.xi.size(); ++j)
          value += interpolation[s](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                   f(t.samplings[s].basis.xi[j]);
        EXPECT_NEAR(value, f(at[i]), 1e-12) << "degree " << k << " set " << s;
      }
    }
  }
}

TEST(ElementTables, WithoutTyingStrainsAreTakenWhereTheyAreWanted) {
  for (const Shape shape : {Shape::quadrilateral, Shape::triangle})
    for (int k = 1; k <= 2; ++k) {
      const ElementTables t = element_tables(shape, k, false);
      ASSERT_EQ(t.samplings.size(), 1u);
      EXPECT_EQ(t.samplings[0].basis.xi, t.quadrature.xi);
      EXPECT_TRUE(tied_interpolation(t, {{0.2, 0.3}}).empty());
    }
}

// ---- triangles -----------------------------------------------------------------------------------------------------

/// int of x^p y^q over the triangle.
double moment(int p, int q) { return std::tgamma(p + 1) * std::tgamma(q + 1) / std::tgamma(p + q + 3); }

TEST(TriangleTables, AreNeverTied) {
  for (int k = 1; k <= 2; ++k) EXPECT_FALSE(element_tables(Shape::triangle, k, true).tying);
}

TEST(TriangleTables, TheBasisSumsToOneAndItsDerivativesToZero) {
  const std::vector<Eigen::Vector2d> at{{0.2, 0.3}, {0, 1}, {0.9, 0.05}};
  for (int k = 1; k <= 2; ++k) {
    const BasisAt b = basis_at(Shape::triangle, k, at);
    for (Eigen::Index p = 0; p < b.value.rows(); ++p) {
      EXPECT_NEAR(b.value.row(p).sum(), 1, 1e-15);
      EXPECT_NEAR(b.d1.row(p).sum(), 0, 1e-14);
      EXPECT_NEAR(b.d2.row(p).sum(), 0, 1e-14);
    }
  }
}

TEST(TriangleTables, TheQuadratureIsExactToDegreeTwoKPlusTwo) {
  for (int k = 1; k <= 2; ++k) {
    const ElementTables t = element_tables(Shape::triangle, k, false);
    for (int p = 0; p <= 2 * k + 2; ++p)
      for (int q = 0; p + q <= 2 * k + 2; ++q) {
        double sum = 0;
        for (std::size_t i = 0; i < t.weights.size(); ++i)
          sum += t.weights[i] * std::pow(t.quadrature.xi[i][0], p) * std::pow(t.quadrature.xi[i][1], q);
        EXPECT_NEAR(sum, moment(p, q), 1e-15);
      }
  }
}

// (M21): the rule at the vertices is exact to degree 1. The rule at the middles of the edges is exact to degree 2 and needs no vertices.
TEST(TriangleTables, TheNodalQuadratureIsExactToTheDegree) {
  for (int k = 1; k <= 2; ++k) {
    const ElementTables t = element_tables(Shape::triangle, k, false);
    ASSERT_EQ(t.nodal_weights.size(), t.nodes.size());
    for (int p = 0; p <= k; ++p)
      for (int q = 0; p + q <= k; ++q) {
        double sum = 0;
        for (std::size_t i = 0; i < t.nodes.size(); ++i)
          sum += t.nodal_weights[i] * std::pow(t.nodes[i][0], p) * std::pow(t.nodes[i][1], q);
        EXPECT_NEAR(sum, moment(p, q), 1e-16);
      }
    for (std::size_t i = 0; i < t.nodes.size(); ++i) {
      const bool is_vertex = t.nodes[i].maxCoeff() == 1 || t.nodes[i].norm() == 0;
      EXPECT_EQ(t.nodal_weights[i] > 0, k == 1 || !is_vertex);
    }
  }
}

TEST(TriangleTables, TheReactionBetweenNodesHasTheIntegralOfTheNodalQuadrature) {
  const auto rule = mesh::triangle_rule(4);
  for (int k = 1; k <= 2; ++k) {
    const ElementTables t = element_tables(Shape::triangle, k, false);
    const MatrixXd basis = reaction_basis_at(Shape::triangle, k, rule.points);
    for (Eigen::Index i = 0; i < basis.cols(); ++i) {
      double integral = 0;
      for (std::size_t q = 0; q < rule.weights.size(); ++q)
        integral += rule.weights[q] * basis(static_cast<Eigen::Index>(q), i);
      EXPECT_NEAR(integral, t.nodal_weights[static_cast<std::size_t>(i)], 1e-15);
    }
  }
}

TEST(ResultantContinuation, ReproducesPolynomialsOneDegreeLower) {
  const std::vector<Eigen::Vector2d> at{{0.2, 0.3}, {0, 1}, {0.9, 0.05}};
  for (const Shape shape : {Shape::quadrilateral, Shape::triangle})
    for (int k = 1; k <= 2; ++k) {
      const auto from = resultant_points(shape, k);
      const MatrixXd m = resultant_continuation(shape, k, at);
      ASSERT_EQ(m.cols(), static_cast<Eigen::Index>(from.size()));
      const auto f = [&](const Eigen::Vector2d& xi) { return k == 1 ? 3.0 : 3 + 2 * xi[0] - 5 * xi[1]; };
      for (std::size_t p = 0; p < at.size(); ++p) {
        double value = 0;
        for (std::size_t q = 0; q < from.size(); ++q)
          value += m(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(q)) * f(from[q]);
        EXPECT_NEAR(value, f(at[p]), 1e-13);
      }
    }
}

}  // namespace
}  // namespace plastron::element

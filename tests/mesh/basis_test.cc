// Quadrature and Lagrange bases on [0, 1].
#include <gtest/gtest.h>
#include <plastron/mesh/basis.hpp>

#include <cmath>
#include <numeric>

#include "geometry/finite_differences.hpp"

namespace plastron::mesh {
namespace {

/// int_0^1 x^degree by a rule, less the exact 1 / (degree + 1).
double error(const Rule& rule, int degree) {
  double sum = -1.0 / (degree + 1);
  for (std::size_t q = 0; q < rule.points.size(); ++q) sum += rule.weights[q] * std::pow(rule.points[q], degree);
  return std::abs(sum);
}

void expect_exact_up_to(const Rule& rule, int degree) {
  for (int p = 0; p <= degree; ++p) EXPECT_LT(error(rule, p), 1e-15) << "degree " << p;
  EXPECT_GT(error(rule, degree + 1), 1e-15) << "degree " << degree + 1;
}

void expect_symmetric_and_positive(const Rule& rule) {
  const std::size_t n = rule.points.size();
  EXPECT_NEAR(std::accumulate(rule.weights.begin(), rule.weights.end(), 0.0), 1, 1e-15);
  EXPECT_TRUE(std::is_sorted(rule.points.begin(), rule.points.end()));
  for (std::size_t q = 0; q < n; ++q) {
    EXPECT_GT(rule.weights[q], 0);
    EXPECT_NEAR(rule.points[q] + rule.points[n - 1 - q], 1, 1e-15);
    EXPECT_NEAR(rule.weights[q], rule.weights[n - 1 - q], 1e-15);
  }
}

class Points : public testing::TestWithParam<int> {};

TEST_P(Points, of_a_gauss_rule_are_exact_for_degree_2n_minus_1_and_no_more) {
  const int n = GetParam();
  const Rule rule = gauss(n);
  ASSERT_EQ(rule.points.size(), static_cast<std::size_t>(n));
  expect_symmetric_and_positive(rule);
  expect_exact_up_to(rule, 2 * n - 1);
}

TEST_P(Points, of_a_gauss_lobatto_rule_have_both_ends_and_are_exact_for_degree_2n_minus_3_and_no_more) {
  const int n = GetParam() + 1;
  const Rule rule = gauss_lobatto(n);
  ASSERT_EQ(rule.points.size(), static_cast<std::size_t>(n));
  EXPECT_EQ(rule.points.front(), 0);
  EXPECT_EQ(rule.points.back(), 1);
  expect_symmetric_and_positive(rule);
  expect_exact_up_to(rule, 2 * n - 3);
}

INSTANTIATE_TEST_SUITE_P(Counts, Points, testing::Range(1, 10));

class Lagrange : public testing::TestWithParam<int> {
 protected:
  std::vector<double> nodes = gauss_lobatto(GetParam() + 1).points;
};

TEST_P(Lagrange, polynomials_are_one_at_their_node_and_zero_at_the_others) {
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    const LagrangeValues l = lagrange(nodes, nodes[j]);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      EXPECT_NEAR(l.value[static_cast<Eigen::Index>(i)], i == j, i == j ? 1e-15 : 0);
  }
}

TEST_P(Lagrange, polynomials_sum_to_one_and_their_derivatives_to_zero) {
  for (const double x : {0.0, 0.1, 0.4, 0.77, 1.0}) {
    const LagrangeValues l = lagrange(nodes, x);
    EXPECT_NEAR(l.value.sum(), 1, 1e-14);
    EXPECT_NEAR(l.d.sum(), 0, 1e-12);
    EXPECT_NEAR(l.dd.sum(), 0, 1e-10);
  }
}

TEST_P(Lagrange, derivatives_agree_with_finite_differences) {
  for (const double x : {0.1, 0.4, 0.77}) {
    const LagrangeValues l = lagrange(nodes, x);
    const Eigen::VectorXd d = geometry::derivative([&](double t) { return lagrange(nodes, t).value; }, x);
    const Eigen::VectorXd dd = geometry::derivative([&](double t) { return lagrange(nodes, t).d; }, x);
    EXPECT_LT((l.d - d).norm(), 1e-11);
    EXPECT_LT((l.dd - dd).norm(), 1e-9);
  }
}

TEST_P(Lagrange, interpolation_keeps_polynomials_of_its_degree) {
  const int k = GetParam();
  for (const double x : {0.0, 0.3, 0.9}) {
    const LagrangeValues l = lagrange(nodes, x);
    double value = 0, d = 0, dd = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double f = std::pow(1 + nodes[i], k);
      value += l.value[static_cast<Eigen::Index>(i)] * f;
      d += l.d[static_cast<Eigen::Index>(i)] * f;
      dd += l.dd[static_cast<Eigen::Index>(i)] * f;
    }
    EXPECT_NEAR(value, std::pow(1 + x, k), 1e-12);
    EXPECT_NEAR(d, k * std::pow(1 + x, k - 1), 1e-10);
    EXPECT_NEAR(dd, k * (k - 1) * std::pow(1 + x, k - 2), 1e-8);
  }
}

TEST_P(Lagrange, tables_hold_the_values_at_each_point_in_a_row) {
  const std::vector<double> points{0.2, 0.5};
  const LagrangeTable table = lagrange_table(nodes, points);
  for (Eigen::Index p = 0; p < 2; ++p) {
    const LagrangeValues l = lagrange(nodes, points[static_cast<std::size_t>(p)]);
    EXPECT_EQ(table.value.row(p).transpose(), l.value);
    EXPECT_EQ(table.d.row(p).transpose(), l.d);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Lagrange, testing::Range(1, 9));

}  // namespace
}  // namespace plastron::mesh

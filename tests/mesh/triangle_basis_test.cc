// Lagrange polynomials and quadrature of the reference triangle.
#include <gtest/gtest.h>
#include <plastron/mesh/basis.hpp>

#include <cmath>
#include <numeric>

namespace plastron::mesh {
namespace {

/// int of x^p y^q over the triangle: p! q! / (p + q + 2)!
double moment(int p, int q) { return std::tgamma(p + 1) * std::tgamma(q + 1) / std::tgamma(p + q + 3); }

TEST(TriangleRule, integrates_polynomials_up_to_its_degree_exactly) {
  for (const int degree : {1, 2, 3, 4, 5, 6, 7, 10, 13}) {
    const TriangleRule rule = triangle_rule(degree);
    for (int p = 0; p <= degree; ++p)
      for (int q = 0; p + q <= degree; ++q) {
        double sum = 0;
        for (std::size_t i = 0; i < rule.points.size(); ++i)
          sum += rule.weights[i] * std::pow(rule.points[i][0], p) * std::pow(rule.points[i][1], q);
        EXPECT_NEAR(sum, moment(p, q), 1e-15) << "degree " << degree << " of x^" << p << " y^" << q;
      }
  }
}

TEST(TriangleRule, has_positive_weights_inside) {
  for (const int degree : {1, 2, 3, 4, 6, 9}) {
    const TriangleRule rule = triangle_rule(degree);
    for (const double w : rule.weights) EXPECT_GT(w, 0);
    for (const Vector2d& p : rule.points) EXPECT_TRUE(holds(Shape::triangle, p, -1e-3));
  }
}

// A cell may begin at any corner: turning the triangle maps the points onto each other.
TEST(TriangleRule, of_the_elements_is_symmetric) {
  for (const int degree : {1, 2, 4, 6}) {
    const TriangleRule rule = triangle_rule(degree);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const Vector2d turned(rule.points[i][1], 1 - rule.points[i][0] - rule.points[i][1]);
      double weight = 0;
      for (std::size_t j = 0; j < rule.points.size(); ++j)
        if ((rule.points[j] - turned).norm() < 1e-14) weight = rule.weights[j];
      EXPECT_EQ(weight, rule.weights[i]);
    }
  }
}

TEST(TriangleLagrange, is_one_at_its_node_and_zero_at_the_others) {
  for (const int order : {1, 2, 3, 5}) {
    const auto nodes = lattice(Shape::triangle, order);
    ASSERT_EQ(nodes.size(), static_cast<std::size_t>(nodes_per_cell(Shape::triangle, order)));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const LatticeValues v = lattice_values(Shape::triangle, order, nodes[i]);
      for (Eigen::Index j = 0; j < v.value.size(); ++j)
        EXPECT_NEAR(v.value[j], j == static_cast<Eigen::Index>(i) ? 1 : 0, 1e-13);
    }
  }
}

}  // namespace
}  // namespace plastron::mesh

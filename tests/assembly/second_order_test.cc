// The second-order strain that linear strains leave out, against integrals done by hand.
#include <plastron/assembly/second_order.hpp>
#include <plastron/domain/domain.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/sample_shells.hpp"

namespace plastron::assembly {
namespace {

constexpr double nu = 0.3;  // of test::steel_like(), E = 1

ShellOperator make(const test::Element& element, const std::array<std::string, 3>& chart, bool is_covariant = false) {
  const auto [shape, degree, tying] = element;
  const auto m = test::meshed(domain::Rectangle{.cells = {2, 1}}, chart, degree, 1, shape);
  return {m.space, m.surface, test::steel_of(geometry::Expression(0.1)), tying, is_covariant};
}

const std::vector<test::Element> elements{{test::quadrilateral, 1, true},
                                          {test::quadrilateral, 3, true},
                                          {test::quadrilateral, 2, false},
                                          {test::triangle, 1, false},
                                          {test::triangle, 2, false}};

/// (u, r) that has nothing to do with symmetries of the square.
algebra::Vector some_field(const ShellOperator& shell, double phase) {
  return test::interpolant(shell, [&](const NodalPoint& p) {
    Eigen::Matrix<double, 6, 1> y;
    for (int k = 0; k < 6; ++k) y[k] = std::sin(phase + k + 2 * p.x[0] - (k + 1) * p.x[1]);
    return y;
  });
}

algebra::Vector sum(const algebra::Vector& a, double factor, const algebra::Vector& b) {
  algebra::Vector result = a;
  for (std::size_t i = 0; i < result.local().size(); ++i) result.local()[i] += factor * b.local()[i];
  return result;
}

// u = (c x, 0, b x): N_11 = E e c / (1 - nu^2), q_11 = (b^2 + c^2) / 2, strains c and bending 0. The plate is turned by 90 degrees, too.
TEST(SecondOrder, OfAnInclinedStretchedPlateIsKnown) {
  const double b = 0.2, c = 0.03, q = (b * b + c * c) / 2, stiffness = 0.1 / (1 - nu * nu);
  for (const test::Element& element : elements)
    for (const bool is_turned : {false, true}) {
      const ShellOperator shell = is_turned ? make(element, {"0.3", "y", "-x"}) : make(element, test::flat);
      const auto y = test::interpolant(shell, [&](const NodalPoint& p) {
        const double x = p.x[0];
        return is_turned ? (Eigen::Matrix<double, 6, 1>() << b * x, 0, -c * x, 0, 0, b).finished()
                         : (Eigen::Matrix<double, 6, 1>() << c * x, 0, b * x, -b, 0, 0).finished();
      });
      const SecondOrder left_out = second_order(shell, y);
      EXPECT_NEAR(left_out.work, stiffness * c * q, 1e-13);
      EXPECT_NEAR(left_out.stretch, stiffness * q * q / 2, 1e-13);
      EXPECT_NEAR(left_out.largest_strain, c, 1e-12);
    }
}

TEST(SecondOrder, OfARigidRotationIsStretchWithoutWork) {
  const double w = 0.5, q = w * w / 2;  // q_11 = q_22 = w^2 / 2
  for (const test::Element& element : elements) {
    const ShellOperator shell = make(element, test::flat);
    const auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
    const SecondOrder left_out = second_order(shell, test::rigid_motion(shell.space(), points, {1, 2, 3}, {0, 0, w}));
    EXPECT_NEAR(left_out.stretch, 0.1 / (1 - nu) * q * q, 1e-12);
    EXPECT_NEAR(left_out.work, 0, 1e-12);
    EXPECT_LT(left_out.largest_strain, 1e-12);
  }
}

TEST(SecondOrder, ForcesAreTheDerivativeOfItsWork) {
  for (const bool is_covariant : {false, true})
    for (const test::Element& element : elements) {
      const ShellOperator shell = make(element, test::saddle, is_covariant);
      const algebra::Vector y = some_field(shell, 0.2), w = some_field(shell, 1.1);
      const algebra::Vector f = second_order_forces(shell, y);
      const double work = second_order(shell, y).work;
      // A form of third degree: the difference is the derivative and the form of w alone.
      const double derivative = (second_order(shell, sum(y, 1, w)).work - second_order(shell, sum(y, -1, w)).work) / 2 -
                                second_order(shell, w).work;
      EXPECT_NEAR(algebra::dot(f, w), derivative, 1e-11 * std::abs(derivative));
      EXPECT_NEAR(algebra::dot(f, y), 3 * work, 1e-11 * std::abs(work));
      EXPECT_NEAR(algebra::dot(geometric_forces(shell, y, y), y), 2 * work, 1e-11 * std::abs(work));
      const double beside = second_order(shell, y).stretch - algebra::dot(f, w) + shell.energies(w).total();
      EXPECT_NEAR(stretch_beside(shell, y, w), beside, 1e-11 * std::abs(beside));
    }
}

}  // namespace
}  // namespace plastron::assembly

// Norms of fields, those of the space V (M10) among them, and what linear strains leave out, against integrals done by hand.
#include <plastron/assembly/field_norms.hpp>
#include <plastron/assembly/second_order.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/sample_shells.hpp"

namespace plastron::assembly {
namespace {

ShellOperator make(const fem::Domain& domain, const std::array<std::string, 3>& chart, int degree, int refinements) {
  const auto m = test::meshed(domain, chart, degree, refinements);
  return {m.space, m.surface, test::steel_of(geometry::Expression(0.1)), true, false};
}

/// The interpolant of a function of position on the mid-surface, its value (u, r).
template <class Function>
algebra::Vector interpolant(const ShellOperator& shell, const Function& f) {
  const auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
  algebra::Vector y(shell.space().layout, 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Matrix<double, 6, 1> value = f(points[i]);
    for (std::size_t k = 0; k < 6; ++k) y.local()[6 * i + k] = value[static_cast<Eigen::Index>(k)];
  }
  return y;
}

// u = (x^2, x y, 0), r = (0, y, 1) on the unit square:
// int |u|^2 = 1/5 + 1/9, int |grad u|^2 = 4/3 + 1/3 + 1/3, int |r|^2 = 1/3 + 1, int |grad r|^2 = 1.
TEST(FieldNorms, OfPolynomialsOnTheFlatSquareAreTheirIntegrals) {
  const ShellOperator shell = make(fem::Rectangle{.cells = {2, 1}}, test::flat, 2, 1);
  const auto y = interpolant(shell, [](const NodalPoint& p) {
    const double a = p.x[0], b = p.x[1];
    return (Eigen::Matrix<double, 6, 1>() << a * a, a * b, 0, 0, b, 1).finished();
  });
  const SquaredNorms n = squared_norms(shell, y);
  EXPECT_NEAR(n.u, 1.0 / 5 + 1.0 / 9, 1e-13);
  EXPECT_NEAR(n.grad_u, 2, 1e-12);
  EXPECT_NEAR(n.r, 4.0 / 3, 1e-13);
  EXPECT_NEAR(n.grad_r, 1, 1e-12);
  EXPECT_NEAR(n.l2(1), n.u + n.r, 1e-15);
  EXPECT_NEAR(n.h1(1), n.u + n.grad_u + n.r + n.grad_r, 1e-15);
  EXPECT_NEAR(n.h1(2), (n.u / 4 + n.grad_u + n.r + 4 * n.grad_r) / 4, 1e-15);
}

TEST(FieldNorms, DoNotDependOnTheParameters) {
  const auto f = [](const NodalPoint& p) {
    const double a = p.phi[0], b = p.phi[1];
    return (Eigen::Matrix<double, 6, 1>() << a * b, a, b, a + b, 0, a * a).finished();
  };
  const fem::Polygon skewed{
      {{0, 0}, {1, 0}, {1.5, 1}, {0.5, 1}}};  // the parallelogram over which phi is the unit square
  const ShellOperator straight = make(fem::Rectangle{.cells = {2, 2}}, {"x", "y", "0"}, 2, 1);
  const ShellOperator skew = make(skewed, {"x - y/2", "y", "0"}, 2, 1);
  const SquaredNorms a = squared_norms(straight, interpolant(straight, f)),
                     b = squared_norms(skew, interpolant(skew, f));
  EXPECT_NEAR(a.u, b.u, 1e-12);
  EXPECT_NEAR(a.grad_u, b.grad_u, 1e-12);
  EXPECT_NEAR(a.r, b.r, 1e-12);
  EXPECT_NEAR(a.grad_r, b.grad_r, 1e-12);
}

// On a sphere |phi| = 2 about the centre c, int |phi - c|^2 dS = 4 area and int |grad phi|^2 dS = 2 area.
TEST(FieldNorms, OfThePositionOnASphereKnowItsRadiusAndArea) {
  const ShellOperator shell = make(fem::Disk{.radius = 0.5}, test::cap, 4, 2);
  const Eigen::Vector3d centre(0, 0, 2);
  const auto y = interpolant(shell, [&](const NodalPoint& p) {
    return (Eigen::Matrix<double, 6, 1>() << p.phi - centre, Eigen::Vector3d::Zero()).finished();
  });
  const SquaredNorms n = squared_norms(shell, y);
  const double area = 2 * M_PI * 2 * (2 - std::sqrt(4 - 0.25));
  EXPECT_NEAR(n.u, 4 * area, 1e-8);
  EXPECT_NEAR(n.grad_u, 2 * area, 1e-6);
}

// u = (0, 0, x), r = (c, 0, 0) on a plate: r_K = (-1, 0, 0), so |r - r_K| = |1 + c| at every point.
TEST(DistanceToKoiter, OfAPlateIsThatOfRAndMinusTheSlope) {
  const ShellOperator shell = make(fem::Rectangle{.to = {2, 1}, .cells = {2, 1}}, test::flat, 2, 1);
  for (const double c : {-1.0, 0.0, 0.5}) {
    const auto y = interpolant(shell, [&](const NodalPoint& p) {
      return (Eigen::Matrix<double, 6, 1>() << 0, 0, p.x[0], c, 0, 0).finished();
    });
    EXPECT_NEAR(squared_distance_to_koiter(shell, y), 2 * (1 + c) * (1 + c), 1e-12);
  }
}

TEST(DistanceToKoiter, OfARigidMotionIsZero) {
  const ShellOperator shell = make(fem::Rectangle{.cells = {2, 2}}, test::saddle, 3, 1);
  const auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
  const auto y = test::rigid_motion(shell.space(), points, {1, 2, 3}, {0.3, -0.2, 0.5});
  EXPECT_LT(std::sqrt(squared_distance_to_koiter(shell, y)), 1e-2 * std::sqrt(squared_norms(shell, y).r));
}

constexpr double nu = 0.3;  // of test::steel_like(), E = 1

ShellOperator make(const test::Element& element, const std::array<std::string, 3>& chart, bool is_covariant = false) {
  const auto [shape, degree, tying] = element;
  const auto m = test::meshed(fem::Rectangle{.cells = {2, 1}}, chart, degree, 1, shape);
  return {m.space, m.surface, test::steel_of(geometry::Expression(0.1)), tying, is_covariant};
}

const std::vector<test::Element> elements{{test::quadrilateral, 1, true},
                                          {test::quadrilateral, 3, true},
                                          {test::quadrilateral, 2, false},
                                          {test::triangle, 1, false},
                                          {test::triangle, 2, false}};

/// (u, r) that has nothing to do with symmetries of the square.
algebra::Vector some_field(const ShellOperator& shell, double phase) {
  return interpolant(shell, [&](const NodalPoint& p) {
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
      const auto y = interpolant(shell, [&](const NodalPoint& p) {
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

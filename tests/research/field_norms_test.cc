// Norms of fields, those of the space V (M10) among them, against integrals done by hand.
#include "assembly/sample_shells.hpp"

#include <plastron/domain/domain.hpp>
#include <research/spectra/field_norms.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace plastron::spectra {
namespace {

energy::ShellOperator shell_on(const domain::Domain& domain, const std::array<std::string, 3>& chart, int degree,
                               int refinements) {
  const auto m = test::meshed(domain, chart, degree, refinements);
  return {m.space, m.surface, test::steel_of(geometry::Expression(0.1)), true, false};
}

// u = (x^2, x y, 0), r = (0, y, 1) on the unit square:
// int |u|^2 = 1/5 + 1/9, int |grad u|^2 = 4/3 + 1/3 + 1/3, int |r|^2 = 1/3 + 1, int |grad r|^2 = 1.
TEST(FieldNorms, OfPolynomialsOnTheFlatSquareAreTheirIntegrals) {
  const energy::ShellOperator shell = shell_on(domain::Rectangle{.cells = {2, 1}}, test::flat, 2, 1);
  const auto y = test::interpolant(shell, [](const assembly::NodalPoint& p) {
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
  const auto f = [](const assembly::NodalPoint& p) {
    const double a = p.phi[0], b = p.phi[1];
    return (Eigen::Matrix<double, 6, 1>() << a * b, a, b, a + b, 0, a * a).finished();
  };
  const domain::Polygon skewed{
      {{0, 0}, {1, 0}, {1.5, 1}, {0.5, 1}}};  // the parallelogram over which phi is the unit square
  const energy::ShellOperator straight = shell_on(domain::Rectangle{.cells = {2, 2}}, {"x", "y", "0"}, 2, 1);
  const energy::ShellOperator skew = shell_on(skewed, {"x - y/2", "y", "0"}, 2, 1);
  const SquaredNorms a = squared_norms(straight, test::interpolant(straight, f)),
                     b = squared_norms(skew, test::interpolant(skew, f));
  EXPECT_NEAR(a.u, b.u, 1e-12);
  EXPECT_NEAR(a.grad_u, b.grad_u, 1e-12);
  EXPECT_NEAR(a.r, b.r, 1e-12);
  EXPECT_NEAR(a.grad_r, b.grad_r, 1e-12);
}

// On a sphere |phi| = 2 about the centre c, int |phi - c|^2 dS = 4 area and int |grad phi|^2 dS = 2 area.
TEST(FieldNorms, OfThePositionOnASphereKnowItsRadiusAndArea) {
  const energy::ShellOperator shell = shell_on(domain::Disk{.radius = 0.5}, test::cap, 4, 2);
  const Eigen::Vector3d centre(0, 0, 2);
  const auto y = test::interpolant(shell, [&](const assembly::NodalPoint& p) {
    return (Eigen::Matrix<double, 6, 1>() << p.phi - centre, Eigen::Vector3d::Zero()).finished();
  });
  const SquaredNorms n = squared_norms(shell, y);
  const double area = 2 * M_PI * 2 * (2 - std::sqrt(4 - 0.25));
  EXPECT_NEAR(n.u, 4 * area, 1e-8);
  EXPECT_NEAR(n.grad_u, 2 * area, 1e-6);
}

// u = (0, 0, x), r = (c, 0, 0) on a plate: r_K = (-1, 0, 0), so |r - r_K| = |1 + c| at every point.
TEST(DistanceToKoiter, OfAPlateIsThatOfRAndMinusTheSlope) {
  const energy::ShellOperator shell = shell_on(domain::Rectangle{.to = {2, 1}, .cells = {2, 1}}, test::flat, 2, 1);
  for (const double c : {-1.0, 0.0, 0.5}) {
    const auto y = test::interpolant(shell, [&](const assembly::NodalPoint& p) {
      return (Eigen::Matrix<double, 6, 1>() << 0, 0, p.x[0], c, 0, 0).finished();
    });
    EXPECT_NEAR(squared_distance_to_koiter(shell, y), 2 * (1 + c) * (1 + c), 1e-12);
  }
}

TEST(DistanceToKoiter, OfARigidMotionIsZero) {
  const energy::ShellOperator shell = shell_on(domain::Rectangle{.cells = {2, 2}}, test::saddle, 3, 1);
  const auto points = assembly::nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
  const auto y = test::rigid_motion(shell.space(), points, {1, 2, 3}, {0.3, -0.2, 0.5});
  EXPECT_LT(std::sqrt(squared_distance_to_koiter(shell, y)), 1e-2 * std::sqrt(squared_norms(shell, y).r));
}

}  // namespace
}  // namespace plastron::spectra

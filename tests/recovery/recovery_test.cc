#include "assembly/sample_shells.hpp"

#include <plastron/domain/domain.hpp>
#include <plastron/recovery/recovery.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace plastron::recovery {
namespace {

const std::vector<Eigen::Vector2d> somewhere{{0.2, 0.3}, {0.9, 0.6}, {0, 1}};

/// A flat plate with nodal values that are given functions of x and y.
template <class Field>
std::vector<PointValues> recovered(int degree, const Field& field, mesh::Shape shape = test::quadrilateral) {
  // Tied bilinear elements have constant states only as parallelograms (docs/methods/tying.md).
  const bool is_bilinear = degree == 1 && shape == test::quadrilateral;
  const domain::Domain domain = is_bilinear ? domain::Domain(domain::Rectangle{}) : domain::Domain(test::skew());
  const auto m = test::meshed(domain, test::flat, degree, 1, shape);
  const auto discrete =
      assembly::discretise(m.space, m.surface, {.sections = test::steel_of(geometry::Expression(0.1))});
  NodalSolution solution{algebra::Vector(m.space->layout, 6), algebra::Vector(m.space->layout, 1),
                         algebra::Vector(m.space->layout, 1)};
  for (std::size_t i = 0; i < discrete->points.size(); ++i) {
    const Eigen::Matrix<double, 6, 1> y = field(discrete->points[i].x);
    for (std::size_t k = 0; k < 6; ++k) solution.y.local()[6 * i + k] = y[static_cast<Eigen::Index>(k)];
  }
  std::vector<PointValues> all;
  const Recovery recovery(*discrete, solution, somewhere);
  for (std::size_t c = 0; c < m.space->owned_cells; ++c)
    for (const PointValues& p : recovery(c)) all.push_back(p);
  return all;
}

using Vector6 = Eigen::Matrix<double, 6, 1>;
constexpr double E = 1, nu = 0.3, e = 0.1, ks = 5.0 / 6;

TEST(Recovery, AConstantMembraneStateOfAPlateHasTheForcesOfPlaneStress) {
  const auto field = [](const Eigen::Vector2d& x) {
    return (Vector6() << 2e-3 * x[0], -1e-3 * x[1], 0, 0, 0, 0).finished();
  };
  std::vector<std::vector<PointValues>> all;
  for (int degree = 1; degree <= 4; ++degree) all.push_back(recovered(degree, field));
  for (int degree = 1; degree <= 2; ++degree) all.push_back(recovered(degree, field, test::triangle));
  for (const auto& points : all)
    for (const PointValues& p : points) {
      EXPECT_NEAR(p.N[0], E * e / (1 - nu * nu) * (2e-3 - nu * 1e-3), 1e-15);
      EXPECT_NEAR(p.N[1], E * e / (1 - nu * nu) * (-1e-3 + nu * 2e-3), 1e-15);
      EXPECT_NEAR(p.N[2], 0, 1e-15);
      EXPECT_NEAR(p.u[0], 2e-3 * p.x[0], 1e-16);
    }
}

// u_3 = -x^2/2 - nu-free twist: r = -grad u_3, constant curvature chi_11 = 1.
TEST(Recovery, ACylindricalBendingOfAPlateHasItsMomentsAndNoShear) {
  const auto field = [](const Eigen::Vector2d& x) {
    return (Vector6() << 0, 0, -x[0] * x[0] / 2, x[0], 0, 0).finished();
  };
  const double D = E * e * e * e / (12 * (1 - nu * nu));
  std::vector<std::vector<PointValues>> all{recovered(2, field, test::triangle)};
  for (int degree = 2; degree <= 4; ++degree) all.push_back(recovered(degree, field));
  for (const auto& points : all)
    for (const PointValues& p : points) {
      EXPECT_NEAR(p.M[0], D, 1e-13);
      EXPECT_NEAR(p.M[1], nu * D, 1e-13);
      EXPECT_NEAR(p.M[2], 0, 1e-13);
      EXPECT_LT(p.Q.norm(), 1e-13);
    }
}

TEST(Recovery, AConstantShearStateHasItsShearForce) {
  const auto field = [](const Eigen::Vector2d& x) { return (Vector6() << 0, 0, 1e-3 * x[1], 0, 0, 0).finished(); };
  std::vector<PointValues> all = recovered(2, field);
  for (const PointValues& p : recovered(2, field, test::triangle)) all.push_back(p);
  for (const PointValues& p : all) {
    EXPECT_NEAR(p.Q[1], ks * e * E / (2 * (1 + nu)) * 1e-3, 1e-16);
    EXPECT_NEAR(p.Q[0], 0, 1e-16);
  }
}

TEST(Recovery, TheFrameIsOrthonormalAndFollowsTheFirstParameter) {
  const auto m = test::meshed(domain::Disk{.radius = 0.8}, test::cap, 3, 1);
  const auto discrete =
      assembly::discretise(m.space, m.surface, {.sections = test::steel_of(geometry::Expression(0.1))});
  const NodalSolution zero{algebra::Vector(m.space->layout, 6), algebra::Vector(m.space->layout, 1),
                           algebra::Vector(m.space->layout, 1)};
  const Recovery recovery(*discrete, zero, somewhere);
  for (std::size_t c = 0; c < m.space->owned_cells; ++c)
    for (const PointValues& p : recovery(c)) {
      Eigen::Matrix3d frame;
      frame << p.t1, p.t2, p.a3;
      EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-13);
      EXPECT_NEAR(frame.determinant(), 1, 1e-13);
      EXPECT_NEAR(p.t1[1], 0, 1e-14);  // d phi / dx of this chart has no y component
      EXPECT_GT(p.a3[2], 0);
      EXPECT_TRUE(std::isnan(p.gap));
    }
}

}  // namespace
}  // namespace plastron::recovery

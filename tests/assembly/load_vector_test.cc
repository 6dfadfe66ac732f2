#include "assembly/sample_shells.hpp"

#include <plastron/assembly/load_vector.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plastron::assembly {
namespace {

Eigen::Matrix<double, 6, 1> total(const algebra::Vector& f) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < f.owned().size(); ++i) sum[static_cast<Eigen::Index>(i % 6)] += f.owned()[i];
  return sum;
}

ShellOperator cap_on_disk(int degree, int refinements, fem::Shape shape = test::quadrilateral) {
  const auto m = test::meshed(fem::Disk{.radius = 0.8}, test::cap, degree, refinements, shape);
  return {m.space, m.surface, geometry::Expression(0.1), test::steel_like(), true, false};
}

// The cap of height h of a sphere of radius 2 has the area 2 pi 2 h.
const double cap_area = 2 * std::numbers::pi * 2 * (2 - std::sqrt(4 - 0.64));

TEST(LoadVector, AConstantForceSumsToForceTimesArea) {
  AreaLoad load;
  load.force[2] = geometry::Expression(-3.0);
  load.couple[0] = geometry::Expression(0.5);
  const auto sum = total(load_vector(cap_on_disk(4, 2), {load}, {}));
  EXPECT_NEAR(sum[2], -3 * cap_area, 1e-9);
  EXPECT_NEAR(sum[3], 0.5 * cap_area, 1e-9);
  EXPECT_NEAR(sum[0], 0, 1e-12);
}

// Pressure along the normal on any cap pushes like pressure on the disk it spans.
TEST(LoadVector, APressureSumsToPressureTimesProjectedArea) {
  const auto shell = cap_on_disk(4, 2);
  AreaLoad load;
  load.pressure = geometry::Expression(2.0);
  const auto sum = total(load_vector(shell, {load}, {}));
  EXPECT_NEAR(sum[2], 2 * std::numbers::pi * 0.64, 1e-9);
}

TEST(LoadVector, AnEdgeLoadSumsToForceTimesLengthOfTheCurveInSpace) {
  EdgeLoad load{.boundary = "rim"};
  load.force[1] = geometry::Expression(7.0);
  load.couple[2] = geometry::Expression("x^2", {});
  const auto sum = total(load_vector(cap_on_disk(4, 2), {}, {load}));
  const double length = 2 * std::numbers::pi * 0.8;
  EXPECT_NEAR(sum[1], 7 * length, 1e-9);
  EXPECT_NEAR(sum[5], 0.64 / 2 * length, 1e-6);
}

TEST(LoadVector, TrianglesCarryTheSameTotals) {
  const auto shell = cap_on_disk(2, 4, test::triangle);
  AreaLoad pressure;
  pressure.pressure = geometry::Expression(2.0);
  EdgeLoad rim{.boundary = "rim"};
  rim.force[1] = geometry::Expression(7.0);
  const auto sum = total(load_vector(shell, {pressure}, {rim}));
  EXPECT_NEAR(sum[2], 2 * std::numbers::pi * 0.64, 1e-8);
  EXPECT_NEAR(sum[1], 7 * 2 * std::numbers::pi * 0.8, 1e-8);
}

TEST(LoadVector, LoadsAsFunctionsAndAsExpressionsAgree) {
  const auto shell = cap_on_disk(2, 1);
  AreaLoad text, function;
  text.force = {geometry::Expression("x*y", {}), geometry::Expression("sin(x)", {}), geometry::Expression("1 + y", {})};
  function.force_function = [](double x, double y) { return Eigen::Vector3d(x * y, std::sin(x), 1 + y); };
  const auto a = load_vector(shell, {text}, {}), b = load_vector(shell, {function}, {});
  for (std::size_t i = 0; i < a.owned().size(); ++i) EXPECT_NEAR(a.owned()[i], b.owned()[i], 1e-15);
}

}  // namespace
}  // namespace plastron::assembly

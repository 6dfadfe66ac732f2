// Solutions with finite rotations (M23-M29), and the comparison of linear solutions with them, against programs for one meridian or
// strip whose digits two methods share.
#include <plastron/computation/solve.hpp>

#include <gtest/gtest.h>

#include "computation/finite_scenes.hpp"

namespace plastron::computation {
namespace {

using namespace test;

struct Expected {
  double energy, reaction, tolerance;
};

/// Solves with finite rotations and compares energy and reaction, and the certificate.
void expect_finite(problem::Problem p, const Expected& expected, double share) {
  p.shell.rotations = element::Rotations::finite;
  const Result r = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  EXPECT_NEAR(r.summary.energy.total() / (share * expected.energy), 1, expected.tolerance);
  if (expected.reaction > 0) {
    EXPECT_NEAR(r.summary.reaction.force.norm() / (share * expected.reaction), 1, expected.tolerance);
  }
  EXPECT_LT(r.certificate.stationarity, 1e-7);  // with a ball, whose curvature the steps leave out
  EXPECT_LT(r.certificate.force_balance, 1e-9);
  EXPECT_LT(r.certificate.moment_balance, 1e-9);
  EXPECT_LT(r.certificate.energy_derivative, 1e-9);
  ASSERT_TRUE(r.stability.has_value());
  EXPECT_GT(r.stability->margin, 0);
  EXPECT_LT(r.stability->margin, 1);
  EXPECT_FALSE(r.model.has_value());
}

/// Compares the solution with finite rotations, and nearly the comparison of the linear solution, with energy and reaction of
/// `share` of the reference's shell.
void expect_model(const problem::Problem& p, const Expected& expected, double share = 1) {
  expect_finite(p, expected, share);
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_TRUE(r.model.has_value());
  EXPECT_TRUE(r.model->is_stable);
  EXPECT_LE(r.model->steps, 8);
  constexpr double some_per_cent = 0.03;
  const auto& numbers = r.model->quantities;
  EXPECT_NEAR(numbers[0].finite / (share * expected.energy), 1, some_per_cent);
  if (expected.reaction > 0) {
    EXPECT_NEAR(numbers[1].finite / (share * expected.reaction), 1, some_per_cent);
  }
}

TEST(FiniteRotations, OfABowlOnATable) {
  problem::Problem p = disk_of({"x", "y", "1.01 + e/2 - sqrt(1 - x^2 - y^2)"}, 0.05, std::sin(0.5));
  p.shell.loads.on_areas = {force(0, 0, -0.02)};
  p.shell.obstacles.all = {table(0)};
  expect_model(p, {1.10810312648616867e-04, 4.00985291066305282e-03, 1e-3});
}

TEST(FiniteRotations, OfADomeUnderAPlateAndUnderABall) {
  problem::Problem p = disk_of({"x", "y", "-1 - e/2 + sqrt(1 - x^2 - y^2)"}, 0.05, std::sin(0.5));
  p.shell.obstacles.all = {table(-0.05, -1)};
  expect_model(p, {9.634875967975481e-06, 4.577351501929052e-04, 1e-4});
  p.shell.obstacles.all = {
      {.shape = obstacle::Ball{.centre = {0, 0, 0.25}, .radius = 0.3}, .face = obstacle::Face::upper}};
  expect_model(p, {5.964374004390057e-06, 2.0688938484945488e-04, 3e-4});
}

TEST(FiniteRotations, OfAPlateThatABallStretches) {  // the linear energy is a fourth of it
  problem::Problem p = disk_of({"x", "y", "-e/2"}, 0.05, 1);
  p.shell.obstacles.all = {
      {.shape = obstacle::Ball{.centre = {0, 0, 0.3}, .radius = 0.5}, .face = obstacle::Face::upper}};
  expect_model(p, {4.915326699123466e-05, 8.98201978554639e-04, 5e-4});
}

TEST(FiniteRotations, OfABowlThatOnlyATableHolds) {
  problem::Problem p = disk_of({"x", "y", "1 + e/2 - sqrt(1 - x^2 - y^2)"}, 0.05, std::sin(0.5));
  const auto at = [](double x, const std::vector<Direction>& directions) {
    Support s = held("", directions);
    s.point = Eigen::Vector2d(x, 0);
    return s;
  };
  p.shell.supports = {at(0, {Direction::x, Direction::y}), at(std::sin(0.5), {Direction::y})};
  p.shell.loads.on_areas = {force(0, 0, -1e-3)};
  p.shell.obstacles.all = {table(0)};
  expect_model(p, {1.291434893676623e-05, 7.691714484729766e-04, 1e-3});
}

TEST(FiniteRotations, OfAStripUnderItsEndForce) {  // the end turns by 1.16 rad
  problem::Problem p = strip_of({"x", "y", "0"}, 0.1, 1, 1);
  p.shell.supports.push_back(clamped("left"));
  p.shell.loads.on_edges = {{.boundary = "right", .force = vector(0, 0, -4e-4)}};
  expect_model(p, {9.243717213451752e-05, 0, 1e-9}, 0.1);
}

TEST(FiniteRotations, OfARingBetweenPlates) {
  problem::Problem p = quarter_ring(0.05, 2);
  p.shell.obstacles.all = {table(-1 - 0.025 + 0.3)};
  // Energy of four quarters, reaction of two, for a width of 1.
  expect_model(p, {1.0944053736183703e-05 / 4, 3.34241391461447e-05 / 2, 1e-4}, 0.1);
}

// A step more where the first one changes much; right to some per cent then.
TEST(FiniteRotations, AreTheSameToSomePerCentWithoutManySteps) {
  problem::Problem p = disk_of({"x", "y", "1.01 + e/2 - sqrt(1 - x^2 - y^2)"}, 0.02, std::sin(0.5));
  p.shell.loads.on_areas = {force(0, 0, -0.002)};
  p.shell.obstacles.all = {table(0)};
  const Result r = solve(p, MPI_COMM_WORLD);
  EXPECT_LE(r.model->steps, 2);
  EXPECT_NEAR(r.model->quantities[0].finite / 8.92086342876441e-06, 1, 0.02);
  EXPECT_NEAR(r.model->quantities[1].finite / 1.5202651846278652e-04, 1, 0.03);
  EXPECT_NEAR(r.model->quantities[0].linear / r.summary.energy.total(), 1, 1e-12);
}

}  // namespace
}  // namespace plastron::computation

// An obstacle whose pressing force is 0 carries nothing: the shell springs back as if the obstacle were not there.
#include <plastron/computation/solve.hpp>
#include <plastron/computation/verify.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "computation/problems.hpp"

namespace plastron::computation::force_off_test {
namespace {

using namespace test;
using contact::Status;
using Eigen::Vector3d;
using obstacle::Obstacle;

/// A plate clamped at both ends, in another unit of length; balls press it from above or from below.
problem::Problem plate(element::Rotations rotations, double unit) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "0"}, {});
  p.domain = domain::Rectangle{.to = {2 * unit, unit}, .cells = {12, 6}};
  p.shell.sections.common.thickness = Expression(0.05 * unit);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1 / (unit * unit), 0.3, 1);
  p.shell.supports = {clamped("left"), clamped("right")};
  p.shell.loads.on_areas.clear();
  p.shell.rotations = rotations;
  p.discretisation = {.degree = 3, .refinements = 0};
  return p;
}

Obstacle ball(const char* name, double x, double side, double force, double unit) {
  return {.name = name,
          .shape = obstacle::Ball{.centre = unit * Vector3d(x, 0.5, side * 0.23), .radius = 0.2 * unit},
          .motions = {},
          .force = {0, 0, -side * force}};
}

Result of(problem::Problem p) { return solve(p, MPI_COMM_WORLD); }

struct Variant {
  element::Rotations rotations;
  double unit, side;
  int parts;
};

TEST(AForceOf0, LetsTheShellSpringBackWhateverThePartsAre) {
  using enum element::Rotations;
  for (const Variant& v : {Variant{finite, 1, 1, 1}, Variant{finite, 1, -1, 3}, Variant{small, 1, 1, 1},
                           Variant{small, 1e-6, -1, 2}, Variant{finite, 1e6, 1, 2}}) {
    SCOPED_TRACE(fmt::format("finite {}, unit {}, side {}, {} parts", v.rotations == finite, v.unit, v.side, v.parts));
    const double force = 2e-5;
    problem::Problem both = plate(v.rotations, v.unit), one = both;
    const Obstacle a = ball("A", 0.6, v.side, force, v.unit), b = ball("B", 1.4, v.side, force, v.unit);
    both.shell.obstacles.all = {a, b};
    both.steps = {{.name = "on"}, {.name = "off", .factors = {.forces = {0, 1}}, .parts = v.parts}};
    one.shell.obstacles.all = {b};
    const Result r = of(both), alone = of(one);
    ASSERT_EQ(r.status, Status::solved) << status_text(r);
    ASSERT_EQ(alone.status, Status::solved) << status_text(alone);
    EXPECT_NEAR(-v.side * r.history.front().summary.obstacles[0].reaction.force[2] / force, 1, 1e-6);
    EXPECT_LT(r.summary.obstacles[0].reaction.force.norm(), 1e-9 * force);
    EXPECT_NEAR(r.summary.energy.total() / alone.summary.energy.total(), 1, 1e-5);
    EXPECT_GE(r.certificate.min_gap_nodes, -1e-9 * v.unit);
  }
}

TEST(AForceOf0, LeavesAShellAtRestThatTheObstacleTouches) {
  problem::Problem p = plate(element::Rotations::finite, 1);
  p.shell.obstacles.all = {ball("A", 1, 1, 1e-5, 1)};
  p.steps = {{.name = "on"}, {.name = "off", .factors = {.forces = {0}}}};
  const Result r = of(p);
  ASSERT_EQ(r.status, Status::solved) << status_text(r);
  EXPECT_LT(r.summary.max_displacement, 1e-6);
}

}  // namespace
}  // namespace plastron::computation::force_off_test

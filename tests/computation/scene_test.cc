// The same scene seen otherwise: turned in space, upside down, with the faces' names exchanged; mirror images.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using obstacle::Face;

/// A clamped shallow bowl pressed on bodies below it, all turned by R: of the chart, of the loads, of the bodies.
Problem bowl(const Matrix3d& R, const std::vector<obstacle::Obstacle>& bodies) {
  Problem p;
  p.domain = fem::Disk{.radius = std::sin(0.5)};
  const std::array<std::string, 3> own{"x", "y", "(1.03 - sqrt(1 - x^2 - y^2))"};
  std::array<std::string, 3> turned;
  for (int i = 0; i < 3; ++i)
    turned[i] =
        fmt::format("({:.17g})*{} + ({:.17g})*{} + ({:.17g})*{}", R(i, 0), own[0], R(i, 1), own[1], R(i, 2), own[2]);
  p.charts = {{"", Chart({turned[0], turned[1], turned[2]}, {})}};
  p.sections.common.thickness = Expression(0.04);
  p.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.supports = {clamped("rim")};
  const Vector3d load = R * Vector3d(2e-4, 0, -4e-3);
  p.area_loads = {force(load[0], load[1], load[2])};
  p.obstacles = bodies;
  for (obstacle::Obstacle& o : p.obstacles) o.placement = {R, Vector3d::Zero()};
  p.discretisation = {.degree = 3, .refinements = 1};
  return p;
}

/// A table, a ball and a box with round edges, alone.
std::vector<obstacle::Obstacle> bodies() {
  return {{.name = "table", .shape = obstacle::HalfSpace{}},
          {.name = "ball", .shape = obstacle::Ball{.centre = {0.05, 0, -0.8}, .radius = 0.8}},
          {.name = "box", .shape = obstacle::Box{.centre = {0, 0.02, -0.1}, .size = {0.3, 0.2, 0.2}, .fillet = 0.05}}};
}

void expect_same(const Result& a, const Result& b, const Matrix3d& R) {
  ASSERT_EQ(a.status, contact::Status::solved) << a.missed_limits;
  ASSERT_EQ(b.status, contact::Status::solved) << b.missed_limits;
  EXPECT_GT(a.summary.touching_nodes, 0);
  EXPECT_EQ(b.summary.touching_nodes, a.summary.touching_nodes);
  EXPECT_NEAR(b.summary.energy.total() / a.summary.energy.total(), 1, 1e-9);
  const Vector3d force = a.summary.reaction.force;
  EXPECT_LT((b.summary.reaction.force - R * force).norm(), 1e-9 * force.norm());
}

TEST(ASceneTurnedInSpace, HasTheSameEnergyAndTurnedReactions) {
  const Matrix3d R = Eigen::AngleAxisd(0.9, Vector3d(1, -2, 2) / 3).toRotationMatrix();
  for (const obstacle::Obstacle& body : bodies()) {
    const Result a = solve(bowl(Matrix3d::Identity(), {body}), MPI_COMM_SELF),
                 b = solve(bowl(R, {body}), MPI_COMM_SELF);
    SCOPED_TRACE(body.name);
    expect_same(a, b, R);
  }
}

TEST(ASceneUpsideDown, HasTheSameEnergyWhicheverWayItsFaceIsNamed) {
  // Exchanging x and y turns a_3 round: the face below is then the upper one. A turn about x by pi leaves its name.
  const Matrix3d turn = Vector3d(1, -1, -1).asDiagonal();
  for (const obstacle::Obstacle& body : bodies()) {
    SCOPED_TRACE(body.name);
    const Result a = solve(bowl(Matrix3d::Identity(), {body}), MPI_COMM_SELF);
    for (const Face face : {Face::lower, Face::nearer}) {
      obstacle::Obstacle named = body;
      named.face = face;
      expect_same(a, solve(bowl(turn, {named}), MPI_COMM_SELF), turn);
    }
    for (const Face face : {Face::upper, Face::nearer}) {
      obstacle::Obstacle named = body;
      named.face = face;
      Problem p = bowl(Matrix3d::Identity(), {named});
      p.charts = {{"", Chart({"y", "x", "1.03 - sqrt(1 - x^2 - y^2)"}, {})}};
      const Result exchanged = solve(p, MPI_COMM_SELF);
      // Another mesh of the same disk: as good as the mesh is.
      EXPECT_NEAR(exchanged.summary.energy.total() / a.summary.energy.total(), 1, 1e-3);
      EXPECT_LT((exchanged.summary.reaction.force - a.summary.reaction.force).norm(),
                1e-3 * a.summary.reaction.force.norm());
    }
  }
}

TEST(APanelSqueezedBetweenTwoPlates, HasMirrorEqualReactions) {
  Problem p;
  p.domain = fem::Rectangle{.from = {-0.5, -0.5}, .to = {0.5, 0.5}, .cells = {2, 2}};
  p.charts = {{"", Chart({"x", "y", "0.02*cos(2*pi*x)"}, {})}};
  p.sections.common.thickness = Expression(0.04);
  p.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.supports = {held("bottom", {Direction::y}), held("left", {Direction::x})};
  const double slot = 0.07;  // of the wave's 0.08
  p.obstacles = {{.name = "floor", .shape = obstacle::HalfSpace{.point = {0, 0, -slot / 2}}},
                 {.name = "ceiling", .shape = obstacle::HalfSpace{.point = {0, 0, slot / 2}, .normal = {0, 0, -1}}}};
  p.discretisation = {.degree = 4, .refinements = 1};
  const Result r = solve(p, MPI_COMM_SELF);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  const Vector3d floor = r.summary.obstacles.at(0).reaction.force, ceiling = r.summary.obstacles.at(1).reaction.force;
  EXPECT_GT(floor[2], 0);
  EXPECT_LT((floor + ceiling).norm(), 1e-8 * floor.norm());
  EXPECT_GT(r.summary.obstacles.at(0).nodes, 0);
}

}  // namespace
}  // namespace plastron::computation

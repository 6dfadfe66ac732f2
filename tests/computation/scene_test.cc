// The same scene in other views: turned in space, upside down, with exchanged names of the faces, and mirrored.
#include <gtest/gtest.h>
#include <plastron/computation/evaluation.hpp>
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

/// A clamped shallow bowl pressed on bodies below it. Chart, loads and bodies are turned by R.
problem::Problem bowl(const Matrix3d& R, const std::vector<obstacle::Obstacle>& bodies) {
  problem::Problem p;
  p.domain = domain::Disk{.radius = std::sin(0.5)};
  const std::array<std::string, 3> own{"x", "y", "(1.03 - sqrt(1 - x^2 - y^2))"};
  std::array<std::string, 3> turned;
  for (int i = 0; i < 3; ++i)
    turned[i] =
        fmt::format("({:.17g})*{} + ({:.17g})*{} + ({:.17g})*{}", R(i, 0), own[0], R(i, 1), own[1], R(i, 2), own[2]);
  p.charts = {{"", Chart({turned[0], turned[1], turned[2]}, {})}};
  p.shell.sections.common.thickness = Expression(0.04);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.supports = {clamped("rim")};
  const Vector3d load = R * Vector3d(2e-4, 0, -4e-3);
  p.shell.loads.on_areas = {force(load[0], load[1], load[2])};
  p.shell.obstacles.all = bodies;
  for (obstacle::Obstacle& o : p.shell.obstacles.all) o.placement = {R, Vector3d::Zero()};
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
  // Exchanging x and y turns a_3 round: the face below is then the upper one. A turn about x by pi keeps its name.
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
      problem::Problem p = bowl(Matrix3d::Identity(), {named});
      p.charts = {{"", Chart({"y", "x", "1.03 - sqrt(1 - x^2 - y^2)"}, {})}};
      const Result exchanged = solve(p, MPI_COMM_SELF);
      // Another mesh of the same disk gives the same results up to the error of the mesh.
      EXPECT_NEAR(exchanged.summary.energy.total() / a.summary.energy.total(), 1, 1e-3);
      EXPECT_LT((exchanged.summary.reaction.force - a.summary.reaction.force).norm(),
                1e-3 * a.summary.reaction.force.norm());
    }
  }
}

/// Invariants of all quantities that have components: N, M, Q and stresses at five heights.
std::vector<double> invariants(const recovery::PointValues& p) {
  std::vector<double> all{p.Q.norm(), shell::largest_von_mises(section_forces(p)).stress};
  const auto add = [&](const Vector3d& tensor) {
    const shell::Principal principal = shell::principal(tensor);
    all.insert(all.end(), {principal.first, principal.second, tensor[0] + tensor[1]});
  };
  add(p.N);
  add(p.M);
  for (const double height : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
    const double z = height * p.thickness;
    add(shell::in_plane_stress(section_forces(p), z));
    all.push_back(shell::von_mises_at(section_forces(p), z));
    all.push_back(shell::shear_stress(section_forces(p), z).norm());
  }
  const auto density = shell::energy_density(p.material, section_forces(p));
  all.insert(all.end(), {density.membrane, density.bending, density.shear});
  return all;
}

/// N in space, where it does not depend on axes.
Matrix3d membrane_forces(const recovery::PointValues& p) {
  return p.N[0] * p.t1 * p.t1.transpose() + p.N[1] * p.t2 * p.t2.transpose() +
         p.N[2] * (p.t1 * p.t2.transpose() + p.t2 * p.t1.transpose());
}

TEST(ASceneTurnedInSpace, HasTheSameInvariantsOfResultantsAndStressesInAnyAxes) {
  const std::vector<problem::Probe> places{
      {"middle", {0.01, 0.02}}, {"inside", {0.2, 0.1}}, {"near the rim", {-0.1, 0.4}}};
  const Matrix3d R = Eigen::AngleAxisd(0.9, Vector3d(1, -2, 2) / 3).toRotationMatrix();
  std::vector<ProbeValue> first;
  for (const Matrix3d& turn : {Matrix3d(Matrix3d::Identity()), R}) {
    problem::Problem p = bowl(turn, {bodies()[1]});
    Result result = solve(p, MPI_COMM_SELF);
    ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
    for (const std::optional<Vector3d>& axis :
         {std::optional<Vector3d>(), std::optional(Vector3d(0, 1, 0)), std::optional(Vector3d(1, -2, 3))}) {
      p.output.axis = axis;
      choose_recovery(p.output, *result.solution);
      const auto values = probe(*result.solution, places);
      if (first.empty()) first = values;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const auto wanted = invariants(first[i].values), found = invariants(values[i].values);
        ASSERT_EQ(found.size(), wanted.size());
        for (std::size_t k = 0; k < found.size(); ++k) {
          EXPECT_GT(std::abs(wanted[k]) + std::abs(wanted[0]), 0);
          EXPECT_NEAR(found[k], wanted[k], 1e-7 * std::abs(wanted[k]) + 1e-10 * std::abs(wanted[1]))
              << places[i].name << ", invariant " << k;
        }
        const Matrix3d N = membrane_forces(first[i].values);
        EXPECT_LT((membrane_forces(values[i].values) - turn * N * turn.transpose()).norm(), 1e-7 * N.norm());
      }
    }
  }
}

// Moments of a scene about a point are those about the origin of the scene moved there.
TEST(AMomentPoint, IsAsGoodAsMovingTheScene) {
  const Vector3d point(0.3, -0.2, 1.5);
  problem::Problem p = bowl(Matrix3d::Identity(), {bodies()[1]});
  const Result origin = solve(p, MPI_COMM_SELF);
  p.output.moment_point = point;
  const Result a = solve(p, MPI_COMM_SELF);
  p.output.moment_point = Vector3d::Zero();
  p.charts = {{"", Chart({"x - 0.3", "y + 0.2", "1.03 - sqrt(1 - x^2 - y^2) - 1.5"}, {})}};
  p.shell.obstacles.all[0].placement = {Matrix3d::Identity(), -point};
  const Result b = solve(p, MPI_COMM_SELF);
  ASSERT_EQ(b.status, contact::Status::solved) << b.missed_limits;
  const auto expect_equal = [](const solution::Wrench& found, const solution::Wrench& wanted) {
    EXPECT_GT(wanted.force.norm(), 0);
    EXPECT_LT((found.force - wanted.force).norm(), 1e-8 * wanted.force.norm());
    EXPECT_LT((found.moment - wanted.moment).norm(), 1e-8 * wanted.force.norm());
  };
  EXPECT_EQ(a.summary.moment_point, point);
  expect_equal(a.summary.loads, b.summary.loads);
  expect_equal(a.summary.reaction, b.summary.reaction);
  expect_equal(a.summary.support_reaction, b.summary.support_reaction);
  expect_equal(a.summary.support_reactions.at(0).reaction, b.summary.support_reactions.at(0).reaction);
  expect_equal(a.summary.obstacles.at(0).reaction, b.summary.obstacles.at(0).reaction);
  expect_equal(a.summary.obstacles.at(0).zones.at(0).reaction, b.summary.obstacles.at(0).zones.at(0).reaction);
  EXPECT_GT((origin.summary.reaction.moment - a.summary.reaction.moment).norm(),
            0.1 * origin.summary.reaction.force.norm());
  EXPECT_EQ(a.certificate.moment_balance, origin.certificate.moment_balance);
}

TEST(APanelSqueezedBetweenTwoPlates, HasMirrorEqualReactions) {
  problem::Problem p;
  p.domain = domain::Rectangle{.from = {-0.5, -0.5}, .to = {0.5, 0.5}, .cells = {2, 2}};
  p.charts = {{"", Chart({"x", "y", "0.02*cos(2*pi*x)"}, {})}};
  p.shell.sections.common.thickness = Expression(0.04);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.supports = {held("bottom", {Direction::y}), held("left", {Direction::x})};
  const double slot = 0.07;  // of the wave's 0.08
  p.shell.obstacles.all = {
      {.name = "floor", .shape = obstacle::HalfSpace{.point = {0, 0, -slot / 2}}},
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

// Shells that only contact holds against some rigid motions. If the load presses them on the obstacles, they come to rest,
// whatever active sets occur on the way. Otherwise they do not.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>

#include <Eigen/Dense>
#include <array>

#include "computation/problems.hpp"

namespace plastron::computation::held_by_contact_test {
namespace {

using namespace test;
using contact::Status;

constexpr double e = 0.05, side = 1, weight = 1e-5;

/// A square panel whose lower face is z = 0 in the middle. Point supports prevent only sliding and spinning.
problem::Problem panel(const std::string& height) {
  problem::Problem p;
  p.domain = domain::Rectangle{.from = {-side / 2, -side / 2}, .to = {side / 2, side / 2}, .cells = {4, 4}};
  p.charts = {{"", Chart({"x", "y", height}, {})}};
  p.shell.sections.common.thickness = Expression(e);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.loads.on_areas = {force(0, 0, -weight)};
  p.shell.supports = {
      {.components = {fixed(Unknown::displacement, Direction::x), fixed(Unknown::displacement, Direction::y)},
       .point = Eigen::Vector2d(0, 0)},
      {.components = {fixed(Unknown::displacement, Direction::y)}, .point = Eigen::Vector2d(side / 2, 0)}};
  p.discretisation = {.degree = 2, .refinements = 1};
  return p;
}

obstacle::Obstacle ball_at(double x, double y) {
  constexpr double radius = 0.1;
  return {.shape = obstacle::Ball{.centre = {x, y, -radius}, .radius = radius}};
}

constexpr std::array<std::array<double, 2>, 3> places{{{0.21, 0.03}, {-0.27, 0.22}, {-0.23, -0.24}}};

/// The forces of statics between the balls and a weight 1 at the origin.
Eigen::Vector3d shares() {
  Eigen::Matrix3d balance;
  for (std::size_t k = 0; k < places.size(); ++k)
    balance.col(static_cast<Eigen::Index>(k)) << 1, places.at(k)[0], places.at(k)[1];
  return balance.partialPivLu().solve(Eigen::Vector3d(1, 0, 0));
}

class PanelOnThreeBalls : public testing::TestWithParam<const char*> {};

TEST_P(PanelOnThreeBalls, ComesToRestWithEachBallAtItsShare) {
  problem::Problem p = panel(GetParam());
  for (const auto& [x, y] : places) p.shell.obstacles.all.push_back(ball_at(x, y));
  const Result r = solve(p, MPI_COMM_SELF);
  ASSERT_EQ(r.status, Status::solved) << r.missed_limits;
  const double total = r.summary.reaction.force[2];
  EXPECT_NEAR(total, weight * side * side, 0.01 * total);
  constexpr double nodes_apart = 0.0625 / 0.45;  // relative: a ball may touch this far beside its place
  for (std::size_t k = 0; k < places.size(); ++k)
    EXPECT_NEAR(r.summary.obstacles.at(k).reaction.force[2], shares()[static_cast<Eigen::Index>(k)] * total,
                nodes_apart * total);
  EXPECT_GE(r.certificate.min_gap_nodes, -1e-9);
  // Linearised again four or five times, with at least one step each.
  for (const Level& level : r.levels) EXPECT_LE(level.iterations - level.linearisations, 8) << level.unknowns;
}

INSTANTIATE_TEST_SUITE_P(Flat, PanelOnThreeBalls, testing::Values("0.025"));
INSTANTIATE_TEST_SUITE_P(Curved, PanelOnThreeBalls, testing::Values("0.025 + 0.02*(x^2 + y^2)"));

/// The energy of a panel whose normal hardly differs from z, as in a mesh with rounded nodes.
double energy_at_rest(const std::vector<obstacle::Shape>& shapes, const std::vector<obstacle::Face>& faces) {
  problem::Problem p = panel("0.025 + 2e-6*y");
  for (const obstacle::Shape& shape : shapes)
    for (const obstacle::Face face : faces) p.shell.obstacles.all.push_back({.shape = shape, .face = face});
  const Result r = solve(p, MPI_COMM_SELF);
  EXPECT_EQ(r.status, Status::solved) << r.missed_limits;
  EXPECT_NEAR(r.summary.reaction.force[2], weight * side * side, 1e-6 * weight);
  return r.summary.energy.total();
}

// The gaps of both faces nearly depend on each other at two rollers.
TEST(APanelWithBothFacesNamed, RestsOnItsLowerFace) {
  using obstacle::Face;
  const auto roller = [](double x) {
    return obstacle::Cylinder{.point = {x, 0, -0.1}, .axis = {0, 1, 0}, .radius = 0.1};
  };
  const std::vector<obstacle::Shape> rollers{roller(-0.25), roller(0.25)};
  const double lower = energy_at_rest(rollers, {Face::lower});
  EXPECT_NEAR(energy_at_rest(rollers, {Face::lower, Face::upper}), lower, 1e-6 * lower);
}

// The middle of the weight is beyond the line between two balls.
TEST(APanelOnTwoBallsAndOneFarAway, TipsOff) {
  problem::Problem p = panel("0.025");
  p.shell.obstacles.all = {ball_at(0.2, 0.2), ball_at(0.3, -0.2), ball_at(0.45, 0)};
  const Result r = solve(p, MPI_COMM_SELF);
  EXPECT_EQ(r.status, Status::not_held);
}

/// A strip in plane strain. Its middle is at the height of the mid-surface there.
problem::Problem strip_pressed_by(double force, const domain::Rectangle& domain,
                                  const std::array<std::string, 3>& chart) {
  problem::Problem p;
  p.domain = domain;
  p.charts = {{"", Chart(chart, {})}};
  p.shell.sections.common.material = shell::Material::from_young_poisson(1e6, 0.3, 1);
  p.shell.supports = {in_plane("bottom"), in_plane("top")};
  p.discretisation = {.degree = 4, .refinements = 1};
  p.shell.obstacles.all = {{.name = "press", .force = {0, 0, -force}}};
  return p;
}

Support kept_from_sliding(double x, double y) {
  return {.components = {fixed(Unknown::displacement, Direction::x)}, .point = Eigen::Vector2d(x, y)};
}

void expect_few_steps(const Result& r, int on_the_coarsest) {
  ASSERT_EQ(r.status, Status::solved) << r.missed_limits;
  EXPECT_LE(r.levels.at(0).iterations, on_the_coarsest);
  for (std::size_t k = 1; k < r.levels.size(); ++k) EXPECT_LE(r.levels[k].iterations, 8) << "mesh " << k;
}

TEST(ATubeBetweenPlates, StartsWhereItTouches) {
  const double pi = 3.141592653589793, length = 0.25;
  problem::Problem p = strip_pressed_by(0.01, {.from = {-pi, 0}, .to = {pi, length}, .cells = {16, 1}},
                                        {"sin(x)", "y", "1.01 - cos(x)"});
  p.joins = {{{"left", "right"}}};
  p.shell.sections.common.thickness = Expression(0.02);
  p.shell.supports.push_back(kept_from_sliding(0, length / 2));
  p.shell.supports.push_back(kept_from_sliding(-pi, length / 2));
  p.shell.obstacles.all.at(0).shape = obstacle::HalfSpace{.point = {0, 0, 2.02}, .normal = {0, 0, -1}};
  p.shell.obstacles.all.push_back({.name = "floor"});
  expect_few_steps(solve(p, MPI_COMM_SELF), 10);
}

TEST(APanelOnTwoRollersPressedByAThird, StartsWhereItTouches) {
  const double width = 0.2, radius = 0.05;
  problem::Problem p =
      strip_pressed_by(0.1, {.from = {-0.6, 0}, .to = {0.6, width}, .cells = {12, 1}}, {"x", "y", "0"});
  p.shell.sections.common.thickness = Expression(e);
  p.shell.supports.push_back(kept_from_sliding(0, width / 2));
  const auto roller = [&](double x, double z) {
    return obstacle::Cylinder{.point = {x, 0, z}, .axis = {0, 1, 0}, .radius = radius};
  };
  p.shell.obstacles.all.at(0).shape = roller(0, e / 2 + radius);
  p.shell.obstacles.all.push_back({.name = "left", .shape = roller(-0.5, -e / 2 - radius)});
  p.shell.obstacles.all.push_back({.name = "right", .shape = roller(0.5, -e / 2 - radius)});
  expect_few_steps(solve(p, MPI_COMM_SELF), 10);
}

}  // namespace
}  // namespace plastron::computation::held_by_contact_test

// The parts of the support reactions that edges, their corners and points carry.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "computation/problems.hpp"

namespace plastron::computation::support_reactions_test {
namespace {

using namespace test;
using Eigen::Vector3d;

/// A plate of thickness 0.02 under its weight of 1 per area, simply supported (only u.z) on all edges in this order. Its in-plane supports are
/// in the middle and carry nothing.
problem::Problem supported_plate(const domain::Domain& domain, const std::vector<std::string>& edges,
                                 int refinements = 1) {
  problem::Problem p = free_plate();
  p.domain = domain;
  p.shell.sections.common.thickness = Expression(0.02);
  for (const std::string& edge : edges) p.shell.supports.push_back(held(edge, {Direction::z}));
  p.shell.supports.push_back(held(edges.front(), {Direction::x, Direction::y}));
  p.shell.loads.on_areas = {force(0, 0, -1)};
  p.discretisation = {.degree = 4, .refinements = refinements};
  return p;
}

const std::vector<std::string> sides{"left", "right", "bottom", "top"};

std::map<std::string, Vector3d> edge_forces(const Result& result) {
  std::map<std::string, Vector3d> forces;
  for (const auto& reaction : result.summary.support_reactions) forces[reaction.boundary] = reaction.reaction.force;
  return forces;
}

/// The parts add up to the whole, in forces and moments.
void expect_sum(const Result& result) {
  solution::Wrench sum = result.summary.support_reaction;
  const double force = sum.force.norm();
  for (const auto& reaction : result.summary.support_reactions) {
    sum.force -= reaction.reaction.force;
    sum.moment -= reaction.reaction.moment;
  }
  for (const auto& corner : result.summary.corner_reactions) {
    sum.force -= corner.reaction.force;
    sum.moment -= corner.reaction.moment;
  }
  for (const auto& point : result.summary.point_reactions) sum.force -= point.force;
  EXPECT_LT(sum.force.norm(), 1e-11 * force);
  if (!result.summary.point_reactions.empty()) return;  // the results give no moments of these
  EXPECT_LT(sum.moment.norm(), 1e-11 * force);
}

// Kirchhoff: each corner is pulled down by 0.0650 q a^2 (Timoshenko and Woinowsky-Krieger, table 8), and the edges carry 1.26 q a^2.
TEST(SupportReactions, of_a_square_are_equal_with_the_corner_forces_of_plate_theory) {
  for (const int refinements : {1, 2}) {
    const Result result =
        solve(supported_plate(domain::Rectangle{.cells = {2, 2}}, sides, refinements), MPI_COMM_WORLD);
    expect_sum(result);
    ASSERT_EQ(result.summary.corner_reactions.size(), 4u);
    for (const auto& corner : result.summary.corner_reactions)
      EXPECT_NEAR(corner.reaction.force[2], -0.065, 0.013) << refinements << ": " << corner.at.transpose();
    const auto forces = edge_forces(result);
    for (const auto& [name, force] : forces) EXPECT_NEAR(force[2], forces.at("left")[2], 1e-9) << name;
    EXPECT_NEAR(forces.at("left")[2], 1.26 / 4, 0.013);
  }
}

TEST(SupportReactions, of_equal_edges_are_equal_whatever_their_order_and_angle) {
  const domain::Polygon rhombus{{{0, 0}, {1, 0}, {1.5, 0.8660254037844386}, {0.5, 0.8660254037844386}}};
  for (const auto& order :
       {std::vector<std::string>{"edge1", "edge2", "edge3", "edge4"}, {"edge3", "edge1", "edge4", "edge2"}}) {
    const Result result = solve(supported_plate(rhombus, order), MPI_COMM_WORLD);
    expect_sum(result);
    const auto forces = edge_forces(result);
    for (const auto& [name, force] : forces) EXPECT_NEAR(force[2], forces.at("edge1")[2], 1e-9) << name;
  }
  const domain::Polygon ell{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  const Result result =
      solve(supported_plate(ell, {"edge1", "edge2", "edge3", "edge4", "edge5", "edge6"}), MPI_COMM_WORLD);
  expect_sum(result);
  const auto forces = edge_forces(result);
  EXPECT_NEAR(forces.at("edge1")[2], forces.at("edge6")[2], 0.01);  // its mesh is not symmetric
  EXPECT_NEAR(forces.at("edge2")[2], forces.at("edge5")[2], 0.01);
  EXPECT_NEAR(forces.at("edge3")[2], forces.at("edge4")[2], 0.01);
}

TEST(SupportReactions, have_the_directions_that_are_fixed) {
  problem::Problem p = free_plate();
  p.shell.supports = {held("bottom", {Direction::y}), clamped("left")};
  p.shell.loads.on_areas = {force(0.1, 0.2, -1)};
  const Result result = solve(p, MPI_COMM_WORLD);
  expect_sum(result);
  const auto forces = edge_forces(result);
  EXPECT_EQ(forces.at("bottom")[0], 0);
  EXPECT_EQ(forces.at("bottom")[2], 0);
  EXPECT_NEAR(forces.at("left")[2], 1, 1e-9);
}

TEST(SupportReactions, share_at_a_corner_what_both_edges_fix) {
  problem::Problem p = free_plate();
  p.shell.supports = {clamped("left"), held("left", {Direction::z}), held("bottom", {Direction::y})};
  p.shell.loads.on_areas = {force(0, 0, -1)};
  const Result result = solve(p, MPI_COMM_WORLD);
  expect_sum(result);
  ASSERT_EQ(result.summary.support_reactions.size(), 2u);
  ASSERT_EQ(result.summary.corner_reactions.size(), 1u);
  EXPECT_NEAR(result.summary.corner_reactions[0].reaction.force[2], 0, 1e-12);  // both fix u.y alone
}

TEST(SupportReactions, leave_a_point_on_an_edge_what_the_edge_does_not_hold) {
  problem::Problem p = supported_plate(domain::Rectangle{.cells = {2, 2}}, sides);
  p.shell.supports.pop_back();
  Support pin = held("", {Direction::x, Direction::y, Direction::z}), guide = held("", {Direction::y});
  pin.point = Eigen::Vector2d(0, 0.5);
  guide.point = Eigen::Vector2d(1, 0.5);
  p.shell.supports.insert(p.shell.supports.begin(), {pin, guide});
  p.shell.loads.on_areas = {force(0, 0, -1)};
  const Result result = solve(p, MPI_COMM_WORLD);
  expect_sum(result);
  ASSERT_EQ(result.summary.point_reactions.size(), 2u);
  for (const auto& point : result.summary.point_reactions) EXPECT_LT(point.force.norm(), 1e-9) << point.at.transpose();
  for (const std::string& warning : result.warnings) EXPECT_EQ(warning.find("point"), std::string::npos) << warning;
}

TEST(SupportReactions, as_goals_are_those_that_are_reported) {
  problem::Problem p = supported_plate(domain::Rectangle{.cells = {2, 2}}, sides);
  p.accuracy = problem::Accuracy{.goals = {{"support.left.force.z", 0.5}, {"support.top.force.z", 0.5}}};
  const Result result = solve(p, MPI_COMM_WORLD);
  const auto forces = edge_forces(result);
  ASSERT_TRUE(result.estimates);
  EXPECT_NEAR(result.estimates->goals[0].value, forces.at("left")[2], 1e-9);
  EXPECT_NEAR(result.estimates->goals[1].value, forces.at("top")[2], 1e-9);
}

}  // namespace
}  // namespace plastron::computation::support_reactions_test

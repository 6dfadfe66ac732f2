// Names of goals and units follow rules, points in space are projected, and a shell that stands on its edge touches with both faces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/problem/both_faces.hpp>
#include <plastron/problem/edge_contact.hpp>
#include <plastron/problem/goal_names.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::problem::names_and_places_test {
namespace {

using testing::ElementsAre;
using Random = std::mt19937;

double drawn(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

Problem with_parts(int probes, int supports, int obstacles, int pressed) {
  Problem p;
  for (int k = 0; k < probes; ++k) p.probes.push_back({.name = "p" + std::to_string(k)});
  for (int k = 0; k < supports; ++k) {
    p.shell.supports.push_back({.boundary = "edge" + std::to_string(k)});
    p.shell.supports.push_back({.boundary = "edge" + std::to_string(k)});  // a second support of the same edge
  }
  p.shell.supports.push_back({.boundary = "", .point = Eigen::Vector2d(0, 0)});
  for (int k = 0; k < obstacles; ++k) {
    p.shell.obstacles.all.push_back({.name = "body" + std::to_string(k)});
    if (k < pressed) p.shell.obstacles.all.back().force = {0, 0, -1};
  }
  return p;
}

// energy, load_work, stress; reaction with its components and contact_area; for each obstacle a force, an area and perhaps a
// position; the supports' reaction and that of each edge; for each probe (u, r), eight resultants, nine stresses and one more.
TEST(GoalNames, AreAsManyAsThePartsOfTheProblemGiveEachOnce) {
  for (int probes = 0; probes < 3; ++probes)
    for (int supports = 0; supports < 3; ++supports)
      for (int obstacles = 0; obstacles < 3; ++obstacles)
        for (int pressed = 0; pressed <= obstacles; ++pressed) {
          Problem p = with_parts(probes, supports, obstacles, pressed);
          const std::vector<std::string> names = goal_names(p);
          const int expected =
              3 + (obstacles > 0 ? 5 : 0) + 5 * obstacles + pressed + 4 + 4 * supports + probes * (6 + 8 + 9 + 1);
          EXPECT_EQ(names.size(), static_cast<std::size_t>(expected));
          EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
          p.accuracy = Accuracy{};
          for (const std::string& name : names) p.accuracy->goals.push_back({name, 0.01});
          const auto goals = estimated_goals(p);  // all are there already
          ASSERT_EQ(goals.size(), names.size());
          for (std::size_t k = 0; k < names.size(); ++k) {
            EXPECT_EQ(goals[k].name, names[k]);
            EXPECT_EQ(goals[k].tolerance, 0.01);
            EXPECT_FALSE(unit_of(goals[k].functional).empty());
          }
        }
}

TEST(GoalNames, HaveTheUnitsOfTheirQuantities) {
  const Problem p = [] {
    Problem all = with_parts(1, 1, 1, 1);
    all.accuracy = Accuracy{};
    for (const std::string& name : goal_names(all)) all.accuracy->goals.push_back({name, 0.1});
    return all;
  }();
  const std::vector<std::pair<std::string, std::string>> by_part{
      {".u.", "m"},      {".r.", "rad"},      {".N.", "N/m"},   {".M.", "N"},  {".Q.", "N/m"},
      {"stress", "Pa"},  {"von_mises", "Pa"}, {"energy", "J"},  {"work", "J"}, {"area", "m^2"},
      {"position", "m"}, {"force", "N"},      {"reaction", "N"}};
  for (const estimation::Goal& goal : estimated_goals(p)) {
    const auto part =
        std::ranges::find_if(by_part, [&](const auto& one) { return goal.name.find(one.first) != std::string::npos; });
    ASSERT_NE(part, by_part.end()) << goal.name;
    EXPECT_EQ(unit_of(goal.functional), part->second) << goal.name;
  }
}

// A sum of forces that cancel asks for nothing: each of several obstacles has its own goal, unless it is given.
TEST(EstimatedGoals, OfASharedReactionHaveTheForceOfEachObstacleToo) {
  Problem p = with_parts(0, 0, 2, 0);
  p.accuracy =
      Accuracy{.goals = {{"reaction.z", 0.1}, {"energy", 0.2}, {"obstacle.body1.force.z", 0.3}, {"reaction", 0.4}}};
  std::vector<std::pair<std::string, double>> found;
  for (const estimation::Goal& goal : estimated_goals(p)) found.emplace_back(goal.name, goal.tolerance.value());
  EXPECT_EQ(found, (std::vector<std::pair<std::string, double>>{{"reaction.z", 0.1},
                                                                {"energy", 0.2},
                                                                {"obstacle.body1.force.z", 0.3},
                                                                {"reaction", 0.4},
                                                                {"obstacle.body0.force.z", 0.1},
                                                                {"obstacle.body0.force", 0.4},
                                                                {"obstacle.body1.force", 0.4}}));
  p.shell.obstacles.all.pop_back();
  p.accuracy->goals = {{"reaction.z", 0.1}};
  EXPECT_EQ(estimated_goals(p).size(), 1U);
}

/// The size of a unit in SI.
double size_of(std::string_view unit) {
  static const std::map<std::string_view, double> sizes{{"m", 1},
                                                        {"mm", 1e-3},
                                                        {"in", 0.0254},
                                                        {"N", 1},
                                                        {"kN", 1e3},
                                                        {"MN", 1e6},
                                                        {"lbf", 4.4482216152605},
                                                        {"Pa", 1},
                                                        {"kPa", 1e3},
                                                        {"MPa", 1e6},
                                                        {"GPa", 1e9},
                                                        {"psi", 6894.757293168361},
                                                        {"J", 1},
                                                        {"mJ", 1e-3},
                                                        {"kJ", 1e3},
                                                        {"MJ", 1e6},
                                                        {"kN/in^2", 1e3 / 0.0254 / 0.0254},
                                                        {"lbf/mm^2", 4.4482216152605e6},
                                                        {"lbf/m^2", 4.4482216152605},
                                                        {"MN/mm^2", 1e12},
                                                        {"MN/in^2", 1e6 / 0.0254 / 0.0254},
                                                        {"N/in^2", 1 / 0.0254 / 0.0254}};
  if (const auto space = unit.find(' '); space != std::string_view::npos)
    return size_of(unit.substr(0, space)) * size_of(unit.substr(space + 1));
  return sizes.at(unit);
}

// A stress is a force over a squared length, and an energy a force times a length.
TEST(UnitNames, OfStressAndEnergyHaveTheSizesOfTheirForcesAndLengths) {
  for (const char* force : {"N", "kN", "MN", "lbf"})
    for (const char* length : {"m", "mm", "in"}) {
      const UnitNames units{.length = length, .force = force};
      const double stress = size_of(force) / size_of(length) / size_of(length),
                   energy = size_of(force) * size_of(length);
      EXPECT_NEAR(size_of(units.label("Pa")), stress, 1e-12 * stress) << force << ", " << length;
      EXPECT_NEAR(size_of(units.label("J")), energy, 1e-12 * energy) << force << ", " << length;
      EXPECT_EQ(units.label("m"), length);
      EXPECT_EQ(units.label("N"), force);
    }
}

// On a plane the nearest point has the same parameters, at any distance. A support takes the nearest corner of a coarse cell.
TEST(LocatePoints, ProjectsPointsInSpace) {
  Random random(1);
  Problem p;
  p.domain = domain::Rectangle{.to = {3, 2}, .cells = {3, 2}};
  p.charts = {{"", geometry::Chart({"x", "y + x/2", "1"}, {})}};
  std::vector<Eigen::Vector2d> expected;
  const auto at_height = [&](const Eigen::Vector2d& x) {
    return Eigen::Vector3d(x[0], x[1] + x[0] / 2, 1 + drawn(random, -2, 2));
  };
  Line line{.name = "line", .points = {{7, 7}}};
  for (int k = 0; k < 20; ++k) {
    expected.emplace_back(drawn(random, 0.1, 2.9), drawn(random, 0.1, 1.9));
    p.probes.push_back({.name = std::to_string(k), .in_space = at_height(expected.back())});
    line.in_space.push_back(at_height(expected.back()));
  }
  p.probes.push_back({.name = "plane", .at = {0.5, 0.5}});
  p.lines = {line};
  p.shell.supports = {{.boundary = "", .point_in_space = Eigen::Vector3d(1.9, 2.05, 1.4)}};
  p.shell.foundations = {{.name = "spring", .point_in_space = at_height(expected.front())}};
  locate_points(p);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_LT((p.probes[k].at - expected[k]).norm(), 1e-9);
    EXPECT_LT((p.lines[0].points.at(k) - expected[k]).norm(), 1e-9);
  }
  EXPECT_EQ(p.lines[0].points.size(), expected.size());
  EXPECT_EQ(p.probes.back().at, Eigen::Vector2d(0.5, 0.5));
  EXPECT_LT((p.shell.supports[0].point.value() - Eigen::Vector2d(2, 1)).norm(), 1e-12);
  EXPECT_LT((p.shell.foundations[0].point.value() - expected.front()).norm(), 1e-9);
}

/// A plate that hangs from y = 0 to y = 1 and makes this angle with the table below its lower edge; it lies at 0 degrees.
Problem leaning(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Problem p;
  p.domain = domain::Rectangle{.cells = {3, 3}};
  p.charts = {{"", geometry::Chart({"x", "(" + std::to_string(c) + ")*y", "(" + std::to_string(s) + ")*y"}, {})}};
  p.shell.sections.common.thickness = geometry::Expression(0.05);
  p.shell.obstacles.all = {
      {.name = "wall",
       .shape = obstacle::HalfSpace{.point = {0, 5, 5}, .normal = Eigen::Vector3d(0, -1, -1).normalized()}},
      {.name = "table", .shape = obstacle::HalfSpace{.point = {0, 0, -0.01}}}};
  p.steps = {{.name = "a", .factors = {.forces = {1, 2}}}, {.name = "b", .factors = {}}};
  p.accuracy = Accuracy{.goals = {{"energy", 0.1}, {"obstacle.table.force.z", 0.2}, {"obstacle.wall.area", 0.3}}};
  return p;
}

std::vector<std::string> names_of(const Problem& p) {
  std::vector<std::string> names;
  for (const obstacle::Obstacle& body : p.shell.obstacles.all) names.push_back(body.name);
  return names;
}

// The cosine of the angle between the table's normal and a_3 is below 0.1 from 84.3 to 95.7 degrees.
TEST(LetBothFacesTouch, WhereAShellStandsOnItsEdge) {
  for (const double degrees : {0.0, 20.0, 80.0, 84.0, 84.5, 90.0, 95.5, 96.0, 135.0}) {
    Problem p = leaning(degrees * std::numbers::pi / 180);
    let_both_faces_touch(p);
    const bool is_standing = std::abs(degrees - 90) < 5.7;
    SCOPED_TRACE(degrees);
    if (!is_standing) {
      EXPECT_THAT(names_of(p), ElementsAre("wall", "table"));
      EXPECT_THAT(p.steps[0].factors.forces, ElementsAre(1, 2));
      continue;
    }
    ASSERT_THAT(names_of(p), ElementsAre("wall", "table, lower face", "table, upper face"));
    EXPECT_EQ(p.shell.obstacles.all[1].face, obstacle::Face::lower);
    EXPECT_EQ(p.shell.obstacles.all[2].face, obstacle::Face::upper);
    EXPECT_TRUE(p.shell.obstacles.all[1].is_for_both && p.shell.obstacles.all[2].is_for_both);
    EXPECT_FALSE(p.shell.obstacles.all[0].is_for_both);
    EXPECT_THAT(p.steps[0].factors.forces, ElementsAre(1, 2, 2));
    EXPECT_TRUE(p.steps[1].factors.forces.empty());
    std::vector<std::string> goals;
    for (const Accuracy::Goal& goal : p.accuracy->goals) goals.push_back(goal.name);
    EXPECT_THAT(goals, ElementsAre("energy", "obstacle.table, lower face.force.z", "obstacle.table, upper face.force.z",
                                   "obstacle.wall.area"));
    const auto known = goal_names(p);
    for (const std::string& goal : goals) EXPECT_TRUE(std::ranges::count(known, goal) == 1) << goal;
    const auto before = names_of(p);
    let_both_faces_touch(p);  // once more: nothing is left to do
    EXPECT_EQ(names_of(p), before);
  }
}

TEST(LetBothFacesTouch, LeavesObstaclesThatAreBoundToAFaceOrPressedOrOnABed) {
  for (const int what : {0, 1, 2}) {
    Problem p = leaning(std::numbers::pi / 2);
    obstacle::Obstacle& table = p.shell.obstacles.all[1];
    if (what == 0) table.face = obstacle::Face::upper;
    if (what == 1) table.force = {0, 0, 1};
    if (what == 2) table.bed = obstacle::Bed(3);
    let_both_faces_touch(p);
    EXPECT_EQ(p.shell.obstacles.all.size(), 2U) << what;
  }
}

}  // namespace
}  // namespace plastron::problem::names_and_places_test

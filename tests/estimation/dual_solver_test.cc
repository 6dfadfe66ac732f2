// Dual solutions are derivatives of goals. They are compared with differences of goals of shells whose load, or whose obstacle's height, is a
// little larger and smaller, with the same active set.
#include <gtest/gtest.h>
#include <plastron/domain/domain.hpp>
#include <plastron/estimation/functionals.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "estimation/solved_shell.hpp"

namespace plastron::estimation::dual_solver_test {
namespace {

using plastron::test::SolvedShell;

struct Scene {
  std::array<std::string, 3> chart = plastron::test::saddle;
  int degree = 2;
  mesh::Shape shape = mesh::Shape::quadrilateral;
  bool has_table = false;
};
void PrintTo(const Scene& scene, std::ostream* out) {
  *out << mesh::corner_count(scene.shape) << " corners, degree " << scene.degree << (scene.has_table ? ", table" : "");
}

/// A change of the scene.
struct Change {
  double load = 0;   ///< factor of a further load, which is not uniform
  double table = 0;  ///< further height of the table [m]
};

SolvedShell solved(const Scene& scene, const Change& change) {
  const geometry::Constants by{{"by", change.load}};
  energy::AreaLoad load{};
  // Tension along x decides at which face of a flat plate the stress is larger.
  load.force = {geometry::Expression("by*y + 0.005", by), geometry::Expression("by*(1 - x*y)", by),
                geometry::Expression("by*sin(3*x) - 0.02", by)};
  load.couple = {geometry::Expression("0.1*by*x", by), geometry::Expression("0.2*by", by), geometry::Expression(0.0)};
  assembly::ShellDescription shell{.sections = plastron::test::steel_of(geometry::Expression(0.1)),
                                   .supports = {plastron::test::clamp("left"), plastron::test::clamp("right")},
                                   .loads = {.on_areas = {load}}};
  if (scene.has_table) {
    obstacle::Obstacle table{};
    table.placement.translation = {0, 0, 0.3 + change.table};
    shell.obstacles.all = {table};
  }
  return {plastron::test::meshed(domain::Rectangle{.cells = {4, 4}}, scene.chart, scene.degree, 0, scene.shape), shell};
}

/// Goals whose derivative does not contain the load itself.
std::vector<Functional> goals(const Scene& scene) {
  std::vector<Functional> all{PointDisplacement{{0.52, 0.37}, 2},
                              PointDisplacement{{0.3, 0.8}, 4},
                              SupportForce{.component = 2},
                              SupportForce{.boundary = "left", .component = 0},
                              SupportForce{.boundary = "right"},
                              PointStress{.at = {0.52, 0.37}, .component = 3},
                              PointStress{.at = {0.9, 0.37}, .kind = StressKind::von_mises}};
  if (scene.has_table) {
    all.emplace_back(ObstacleForce{.obstacle = 0});
    all.emplace_back(ObstacleForce{.component = 2});
  }
  return all;
}

class DualSolutions : public testing::TestWithParam<Scene> {};
class DualSolutionsWithoutContact : public DualSolutions {};
class DualSolutionsOnATable : public DualSolutions {};

const std::vector<Scene> without_contact{{.chart = plastron::test::flat},
                                         {},
                                         {.degree = 3},
                                         {.degree = 1, .shape = mesh::Shape::triangle},
                                         {.degree = 2, .shape = mesh::Shape::triangle}},
    on_a_table{{.has_table = true},
               {.degree = 3, .has_table = true},
               {.degree = 2, .shape = mesh::Shape::triangle, .has_table = true}};

INSTANTIATE_TEST_SUITE_P(WithoutContact, DualSolutions, testing::ValuesIn(without_contact));
INSTANTIATE_TEST_SUITE_P(OnATable, DualSolutions, testing::ValuesIn(on_a_table));
INSTANTIATE_TEST_SUITE_P(Each, DualSolutionsWithoutContact, testing::ValuesIn(without_contact));
INSTANTIATE_TEST_SUITE_P(Each, DualSolutionsOnATable, testing::ValuesIn(on_a_table));

std::int64_t active_count(const SolvedShell& shell) {
  return std::ranges::count_if(shell.solution().activity, [](contact::Activity a) {
    return a == contact::Activity::at_lower || a == contact::Activity::at_upper;
  });
}

/// Half of b - a.
algebra::Vector half_difference(const algebra::Vector& a, const algebra::Vector& b) {
  algebra::Vector half(a.layout(), a.block());
  for (std::size_t i = 0; i < half.owned().size(); ++i) half.owned()[i] = (b.owned()[i] - a.owned()[i]) / 2;
  return half;
}

// The change of a goal with the load b is z . db.
TEST_P(DualSolutions, AreTheDerivativesOfGoalsWithRespectToTheLoad) {
  constexpr double step = 1e-5;  // of 0.02
  SolvedShell middle = solved(GetParam(), {});
  const SolvedShell less = solved(GetParam(), {.load = -step}), more = solved(GetParam(), {.load = step});
  ASSERT_EQ(less.solution().activity, middle.solution().activity);
  ASSERT_EQ(more.solution().activity, middle.solution().activity);
  EXPECT_EQ(active_count(middle) > 0, GetParam().has_table);
  const algebra::Vector change = half_difference(less.box().load, more.box().load);
  for (const Functional& goal : goals(GetParam())) {
    const auto z = middle.dual(goal);
    ASSERT_TRUE(z);
    const double difference = (more.value(goal) - less.value(goal)) / 2;
    EXPECT_GT(std::abs(difference), 1e-7 * std::abs(middle.value(goal))) << goal.index();
    EXPECT_NEAR(algebra::dot(z->z, change), difference, 1e-4 * std::abs(difference)) << goal.index();
  }
}

// The work of the loads is b . u. With u = A^-1 b its change is 2 u . db, and the dual is the solution itself.
TEST_P(DualSolutionsWithoutContact, OfTheWorkOfLoadsAreTheSolution) {
  SolvedShell shell = solved(GetParam(), {});
  const auto z = shell.dual(LoadWork{});
  ASSERT_TRUE(z);
  EXPECT_LT(algebra::max_abs(half_difference(z->z, shell.solution().z)), 1e-7 * algebra::max_abs(shell.solution().z));
}

// The reaction A z - J of the dual is minus the change of a goal with the value of a fixed coordinate.
TEST_P(DualSolutionsOnATable, HaveTheDerivativesWithRespectToItsHeightAsReactions) {
  constexpr double step = 1e-7;
  SolvedShell middle = solved(GetParam(), {});
  const SolvedShell less = solved(GetParam(), {.table = -step}), more = solved(GetParam(), {.table = step});
  ASSERT_EQ(less.solution().activity, middle.solution().activity);
  ASSERT_EQ(more.solution().activity, middle.solution().activity);
  for (const Functional& goal : goals(GetParam())) {
    const auto z = middle.dual(goal);
    ASSERT_TRUE(z);
    double change = 0;
    const auto& activity = middle.solution().activity;
    for (std::size_t i = 0; i < activity.size(); ++i)
      if (activity[i] != contact::Activity::free)
        change -= z->multiplier.owned()[i] * (more.solution().z.owned()[i] - less.solution().z.owned()[i]) / 2;
    const double difference = (more.value(goal) - less.value(goal)) / 2;
    EXPECT_GT(std::abs(difference), 1e-9 * std::abs(middle.value(goal))) << goal.index();
    EXPECT_NEAR(change, difference, 1e-4 * std::abs(difference)) << goal.index();
  }
}

}  // namespace
}  // namespace plastron::estimation::dual_solver_test

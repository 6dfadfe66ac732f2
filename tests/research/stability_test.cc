// The constants in the proofs do not degrade, and the soft modes are those of the theory.
#include <gtest/gtest.h>
#include <research/study/studies.hpp>

#include "computation/problems.hpp"
#include "research/tables.hpp"

namespace plastron::study {
namespace {

using namespace test;

TEST(Stability, OfTheBowlDoesNotDegradeWithMeshSizeOrThickness) {
  problem::Problem p = pressed_bowl();
  p.discretisation = {.degree = 2, .refinements = 2};
  StudyOptions options;
  options.factors = {1, 0.1};
  const Report report = stability(p, options, MPI_COMM_SELF, {});
  EXPECT_EQ(report.table.rows.size(), 6u);
  expect_all_hold(report.table);
  const auto b = numbers(report.table, "inf-sup b"), c = numbers(report.table, "inf-sup c");
  for (const double value : b) EXPECT_NEAR(value, b.front(), 0.05 * b.front());
  for (const double value : c) EXPECT_GT(value, 1 - 1e-6);
}

TEST(Stability, OfSeveralObstaclesIsThatOfTheWorst) {
  problem::Problem p = pressed_bowl();
  p.discretisation = {.degree = 2, .refinements = 0};
  StudyOptions options;
  options.factors = {1};
  const auto constant = [&](std::vector<obstacle::Obstacle> obstacles) {
    p.shell.obstacles.all = std::move(obstacles);
    return numbers(stability(p, options, MPI_COMM_SELF, {}).table, "inf-sup c").at(0);
  };
  // Against a wall that is steep on the shell, w = n . (v + z s) leaves the multiplier weaker.
  const obstacle::Obstacle floor{}, wall{.shape = obstacle::HalfSpace{.point = {-2, 0, 0}, .normal = {1, 0, 0.2}}};
  const double of_floor = constant({floor}), of_wall = constant({wall});
  EXPECT_NE(of_floor, of_wall);
  EXPECT_DOUBLE_EQ(constant({floor, wall}), std::min(of_floor, of_wall));
  EXPECT_DOUBLE_EQ(constant({wall, floor}), std::min(of_floor, of_wall));
}

TEST(Stability, WithoutSupportsIsNotCoercive) {
  problem::Problem p = free_plate();
  StudyOptions options;
  options.factors = {1};
  const Report report = stability(p, options, MPI_COMM_SELF, {});
  for (const double alpha : numbers(report.table, "coercivity")) EXPECT_EQ(alpha, 0);
  EXPECT_EQ(claim_on(report.table, "alpha").verdict, Verdict::cannot_be_judged);
  EXPECT_NE(claim_on(report.table, "alpha").reason.find("rigid motion"), std::string::npos);
}

TEST(SoftModesStudy, OfACylinderFindsTheSeventhModeOfTheRelaxedFormulations) {
  problem::Problem p = with_chart(free_plate(), {"sin(x)", "y", "cos(x)"});
  p.discretisation = {.degree = 2, .refinements = 3};
  const Report report = soft_modes(p, {}, MPI_COMM_SELF, {});
  EXPECT_EQ(report.table.rows.size(), 4u * 4u * 8u);
  expect_all_hold(report.table);
}

TEST(SoftModesStudy, OfACapFindsSixEverywhere) {
  problem::Problem p = pressed_bowl();
  p.shell.sections.common.thickness = Expression(0.05);
  p.discretisation = {.degree = 2, .refinements = 3};
  expect_all_hold(soft_modes(p, {}, MPI_COMM_SELF, {}).table);
}

}  // namespace
}  // namespace plastron::study

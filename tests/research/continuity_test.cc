// The measured changes stay below the bounds proven from the variational inequality (M18).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <research/study/studies.hpp>

#include <algorithm>

#include "computation/problems.hpp"
#include "research/tables.hpp"

namespace plastron::study {
namespace {

using namespace test;

using testing::Contains;
using testing::Each;
using testing::Ge;
using testing::HasSubstr;

TEST(Continuity, of_a_bowl_is_within_its_bounds) {
  problem::Problem p = pressed_bowl();
  p.discretisation = {.degree = 2, .refinements = 2};
  StudyOptions options;
  options.samples = 20;
  const Report report = continuity(p, options, MPI_COMM_SELF, {});
  ASSERT_EQ(report.status, contact::Status::solved);
  EXPECT_EQ(report.table.rows.size(), 60u);
  expect_all_hold(report.table);
  EXPECT_THAT(numbers(report.table, "change"), Each(Ge(0)));
  // The bounds are not far above the changes.
  for (const std::string kind : {"load", "thickness", "height"}) {
    const auto ratios = numbers(report.table, "ratio", kind);
    EXPECT_GT(*std::max_element(ratios.begin(), ratios.end()), 0.3) << kind;
  }
}

TEST(Continuity, of_large_changes_is_within_its_bounds_too) {
  problem::Problem p = pressed_strip();
  p.discretisation = {.degree = 3, .refinements = 1};
  StudyOptions options;
  options.samples = 5;
  options.size = 0.5;
  expect_all_hold(continuity(p, options, MPI_COMM_SELF, {}).table);
}

// Without contact the dual norm equals the change.
TEST(Continuity, of_a_linear_shell_reaches_the_bound_of_the_load) {
  StudyOptions options;
  options.samples = 2;
  const Report report = continuity(cantilever_plate(), options, MPI_COMM_SELF, {});
  expect_all_hold(report.table);
  for (const double ratio : numbers(report.table, "ratio", "load")) EXPECT_NEAR(ratio, 1, 1e-6);
  EXPECT_EQ(report.table.claims.size(), 2u);
}

TEST(Continuity, depends_on_its_seed_alone) {
  StudyOptions options;
  options.samples = 1;
  const auto first = numbers(continuity(cantilever_plate(), options, MPI_COMM_SELF, {}).table, "change");
  EXPECT_EQ(numbers(continuity(cantilever_plate(), options, MPI_COMM_SELF, {}).table, "change"), first);
  options.seed = 2;
  EXPECT_NE(numbers(continuity(cantilever_plate(), options, MPI_COMM_SELF, {}).table, "change"), first);
}

TEST(Continuity, leaves_out_loads_that_only_the_obstacle_bears) {
  problem::Problem p = pressed_strip();
  p.shell.supports = {held("left", {Direction::x, Direction::y}), held("right", {Direction::y})};
  StudyOptions options;
  options.samples = 1;
  const Report report = continuity(p, options, MPI_COMM_SELF, {});
  EXPECT_THAT(report.table.remarks, Contains(HasSubstr("rigid motion")));
}

}  // namespace
}  // namespace plastron::study

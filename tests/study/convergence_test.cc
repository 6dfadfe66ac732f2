// The study of convergence finds the rates that theory gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/study/convergence.hpp>

#include "computation/problems.hpp"
#include "study/tables.hpp"

namespace plastron::study {
namespace {

using namespace test;

using testing::Contains;
using testing::HasSubstr;

/// A square plate clamped all round.
computation::Problem clamped_plate(int degree) {
  computation::Problem p = free_plate();
  p.supports = {clamped("left"), clamped("right"), clamped("bottom"), clamped("top")};
  p.area_loads = {force(0, 0, -1)};
  p.discretisation = {.degree = degree, .refinements = 3};
  return p;
}

/// A plate strip clamped at its ends whose solution varies along it alone and is smooth.
computation::Problem smooth_strip(int degree) {
  computation::Problem p = pressed_strip();
  p.obstacles.clear();
  p.area_loads.front() = {.force = {Expression(), Expression(), Expression("-1e-3 * sin(5*x)", {})}};
  p.discretisation = {.degree = degree, .refinements = 2};
  return p;
}

// (M11), (M21): rate k in the energy and H1 norms, k + 1 in L2.
TEST(Convergence, of_a_strip_has_the_rates_of_its_degree) {
  for (const int degree : {1, 2}) {
    const Report report = convergence(smooth_strip(degree), {}, MPI_COMM_SELF, {});
    ASSERT_EQ(report.status, contact::Status::solved);
    expect_all_hold(report.table);
    EXPECT_NEAR(numbers(report.table, "energy rate").back(), degree, 0.35);
    EXPECT_GT(numbers(report.table, "H1 rate").back(), degree - 0.35);
    EXPECT_GT(numbers(report.table, "L2 rate").back(), degree + 0.35);
    EXPECT_EQ(report.plot.series.size(), 3u);
  }
}

// What is reported against a solution two levels finer hardly depends on that solution.
TEST(Convergence, does_not_depend_much_on_its_reference) {
  computation::Problem p = clamped_plate(2);
  p.discretisation.refinements = 1;
  StudyOptions options;
  const auto two = numbers(convergence(p, options, MPI_COMM_SELF, {}).table, "energy");
  options.reference = 3;
  const auto three = numbers(convergence(p, options, MPI_COMM_SELF, {}).table, "energy");
  for (std::size_t i = 0; i < two.size(); ++i) EXPECT_NEAR(two[i], three[i], 0.02 * three[i]);
}

TEST(Convergence, of_a_pressed_strip_holds_with_and_without_obstacle) {
  computation::Problem p = pressed_strip();
  p.discretisation.refinements = 2;
  const Report report = convergence(p, {}, MPI_COMM_SELF, {});
  ASSERT_EQ(report.status, contact::Status::solved);
  EXPECT_EQ(numbers(report.table, "energy", "with").size(), 3u);
  EXPECT_EQ(numbers(report.table, "energy", "without").size(), 3u);
  expect_all_hold(report.table);
}

TEST(Convergence, leaves_out_the_free_shell_that_nothing_but_the_obstacle_holds) {
  computation::Problem p = pressed_strip();
  p.supports = {held("left", {Direction::x, Direction::y}), held("right", {Direction::y})};
  p.discretisation.refinements = 0;
  const Report report = convergence(p, {}, MPI_COMM_SELF, {});
  EXPECT_THAT(report.table.remarks, Contains(HasSubstr("do not hold")));
  EXPECT_FALSE(report.table.rows.empty());
  for (const auto& row : report.table.rows) EXPECT_EQ(std::get<std::string>(row.front()), "with");
}

TEST(Convergence, tells_how_a_computation_failed) {
  computation::Problem p = free_plate();
  p.area_loads = {force(0, 0, -1)};
  EXPECT_EQ(convergence(p, {}, MPI_COMM_SELF, {}).status, contact::Status::singular);
  p = pressed_strip();
  p.contact.max_iterations = 1;
  EXPECT_EQ(convergence(p, {}, MPI_COMM_SELF, {}).status, contact::Status::iteration_limit);
}

}  // namespace
}  // namespace plastron::study

// The convergence study finds the rates of the theory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <research/study/studies.hpp>

#include <cmath>
#include <cstddef>

#include "computation/problems.hpp"
#include "research/tables.hpp"

namespace plastron::study {
namespace {

using namespace test;

using testing::Contains;
using testing::HasSubstr;

/// A square plate clamped all round.
problem::Problem clamped_plate(int degree) {
  problem::Problem p = free_plate();
  p.shell.supports = {clamped("left"), clamped("right"), clamped("bottom"), clamped("top")};
  p.shell.loads.on_areas = {force(0, 0, -1)};
  p.discretisation = {.degree = degree, .refinements = 3};
  return p;
}

/// A plate strip clamped at its ends whose solution varies along it alone and is smooth.
problem::Problem smooth_strip(int degree) {
  problem::Problem p = pressed_strip();
  p.shell.obstacles.all.clear();
  p.shell.loads.on_areas.front() = {.force = {Expression(), Expression(), Expression("-1e-3 * sin(5*x)", {})}};
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
    EXPECT_EQ(report.plot.series.size(), 4u);
  }
}

// Errors against a solution two levels finer hardly depend on that solution.
TEST(Convergence, does_not_depend_much_on_its_reference) {
  problem::Problem p = clamped_plate(2);
  p.discretisation.refinements = 1;
  StudyOptions options;
  const auto two = numbers(convergence(p, options, MPI_COMM_SELF, {}).table, "energy");
  options.reference = 3;
  const auto three = numbers(convergence(p, options, MPI_COMM_SELF, {}).table, "energy");
  for (std::size_t i = 0; i < two.size(); ++i) EXPECT_NEAR(two[i], three[i], 0.02 * three[i]);
}

TEST(Convergence, of_a_pressed_strip_holds_with_and_without_obstacle) {
  problem::Problem p = pressed_strip();
  p.discretisation.refinements = 2;
  const Report report = convergence(p, {}, MPI_COMM_SELF, {});
  ASSERT_EQ(report.status, contact::Status::solved);
  EXPECT_EQ(numbers(report.table, "energy", "with").size(), 3u);
  EXPECT_EQ(numbers(report.table, "energy", "without").size(), 3u);
  expect_all_hold(report.table);
}

TEST(Convergence, leaves_out_the_free_shell_that_nothing_but_the_obstacle_holds) {
  problem::Problem p = pressed_strip();
  p.shell.supports = {held("left", {Direction::x, Direction::y}), held("right", {Direction::y})};
  p.discretisation.refinements = 0;
  const Report report = convergence(p, {}, MPI_COMM_SELF, {});
  EXPECT_THAT(report.table.remarks, Contains(HasSubstr("do not hold")));
  EXPECT_FALSE(report.table.rows.empty());
  for (const auto& row : report.table.rows) EXPECT_EQ(std::get<std::string>(row.front()), "with");
}

TEST(Convergence, tells_how_a_computation_failed) {
  problem::Problem p = free_plate();
  p.shell.loads.on_areas = {force(0, 0, -1)};
  EXPECT_EQ(convergence(p, {}, MPI_COMM_SELF, {}).status, contact::Status::singular);
  p = pressed_strip();
  p.contact.max_iterations = 1;
  EXPECT_EQ(convergence(p, {}, MPI_COMM_SELF, {}).status, contact::Status::iteration_limit);
}

// ---- both sides of Falk's estimate ------------------------------------------------------------------------------------

// For a pressed strip the estimate needs the reaction: the interpolation error alone is less than the error.
TEST(FalksEstimate, of_a_pressed_strip_holds_by_its_reaction) {
  problem::Problem p = pressed_strip();
  p.discretisation = {.degree = 2, .refinements = 3};
  p.shell.tying = false;
  const Table table = convergence(p, {}, MPI_COMM_SELF, {}).table;
  const auto left = numbers(table, "energy", "with"), right = numbers(table, "right side", "with");
  const auto interpolation = numbers(table, "interpolation", "with"), reaction = numbers(table, "reaction", "with");
  const auto in_l2 = numbers(table, "right side in L2", "with");
  bool needs_reaction = false;
  for (std::size_t l = 0; l < left.size(); ++l) {
    EXPECT_LE(left[l], right[l]);
    EXPECT_LE(right[l], in_l2[l]);
    EXPECT_LT(right[l], 3 * left[l]);  // the estimate is sharp
    EXPECT_NEAR(right[l] * right[l], interpolation[l] * interpolation[l] + reaction[l] * std::abs(reaction[l]),
                1e-9 * right[l] * right[l]);
    needs_reaction = needs_reaction || interpolation[l] < 0.98 * left[l];
  }
  EXPECT_TRUE(needs_reaction);
  EXPECT_EQ(claim_on(table, "Falk's estimate, both sides").verdict, Verdict::holds);
}

// Without contact it is Cea's lemma. U_h is nearest to U of all fields of its space, so the interpolant is farther.
TEST(FalksEstimate, without_contact_is_that_of_cea) {
  problem::Problem p = clamped_plate(2);
  p.shell.tying = false;
  p.discretisation.refinements = 2;
  const Table table = convergence(p, {}, MPI_COMM_SELF, {}).table;
  const auto left = numbers(table, "energy"), right = numbers(table, "right side");
  for (const double reaction : numbers(table, "reaction")) EXPECT_EQ(reaction, 0);
  for (std::size_t l = 0; l < left.size(); ++l) {
    EXPECT_LT(left[l], right[l]);
    EXPECT_LT(right[l], 3 * left[l]);
  }
  EXPECT_EQ(claim_on(table, "Cea's lemma, both sides").verdict, Verdict::holds);
}

// Nested spaces, one form and one load: between meshes of a flat plate without tying only the spaces differ.
TEST(FalksEstimate, has_no_consistency_error_on_a_flat_plate_without_tying) {
  problem::Problem p = pressed_strip();
  p.discretisation = {.degree = 3, .refinements = 1};
  p.shell.tying = false;
  const Table flat = convergence(p, {}, MPI_COMM_SELF, {}).table;
  for (const double c : numbers(flat, "consistency")) EXPECT_NEAR(c, 0, 1e-12);
  p.shell.tying = true;
  const Table tied = convergence(p, {}, MPI_COMM_SELF, {}).table;
  EXPECT_GT(std::abs(numbers(tied, "consistency", "with").front()), 1e-8);
}

// Curved obstacles, curved shells, triangles, covariant components.
TEST(FalksEstimate, holds_for_every_element_and_says_where_it_cannot_be_evaluated) {
  problem::Problem p = with_chart(pressed_strip(), {"x", "y", "0.01 + e/2 + 0.1*x*(1-x)"}, {{"e", 0.05}});
  p.discretisation.refinements = 1;
  const auto falk = [&] {
    return claim_on(convergence(p, {}, MPI_COMM_SELF, {}).table, "Falk's estimate, both sides");
  };
  EXPECT_EQ(falk().verdict, Verdict::holds) << falk().measured << falk().reason;
  p.discretisation.cells = mesh::Shape::triangle;
  EXPECT_EQ(falk().verdict, Verdict::holds) << falk().measured << falk().reason;
  p.discretisation.cells = mesh::Shape::quadrilateral;
  p.shell.tangency.formulation = element::Formulation::classical;
  EXPECT_EQ(falk().verdict, Verdict::holds) << falk().measured << falk().reason;
  p.shell.tangency.formulation = element::Formulation::penalised;
  EXPECT_EQ(falk().verdict, Verdict::cannot_be_judged);
  EXPECT_THAT(falk().reason, HasSubstr("relaxed"));
}

}  // namespace
}  // namespace plastron::study

// The thickness study distinguishes bending from membrane dominated shells.
#include <gtest/gtest.h>
#include <research/study/studies.hpp>

#include "computation/problems.hpp"
#include "research/tables.hpp"

namespace plastron::study {
namespace {

using namespace test;

double fitted(const Table& table, const std::string& quantity) {
  for (const Fit& fit : table.fits)
    if (fit.quantity == quantity) return fit.exponent;
  ADD_FAILURE() << quantity;
  return 0;
}

StudyOptions halvings(int steps) {
  StudyOptions options;
  options.factors = {1};
  for (int i = 0; i < steps; ++i) options.factors.push_back(options.factors.back() / 2);
  return options;
}

// Clamped along one generator, the cylinder rolls up without stretching.
TEST(Thickness, of_a_cylinder_held_along_a_generator_is_bending_dominated) {
  problem::Problem p = with_chart(free_plate(), {"sin(x)", "y", "cos(x)"});
  p.shell.supports = {clamped("left")};
  p.shell.loads.on_areas = {force(0, 0, -1e-6)};
  p.shell.sections.common.thickness = Expression(0.02);
  p.discretisation = {.degree = 3, .refinements = 2};
  const Report report = thickness(p, halvings(3), MPI_COMM_SELF, {});
  ASSERT_EQ(report.status, contact::Status::solved);
  EXPECT_NEAR(fitted(report.table, "stiffness"), 3, 0.05);
  EXPECT_NEAR(fitted(report.table, "energy"), -3, 0.05);
  EXPECT_GT(numbers(report.table, "bending").back(), 95);
  expect_all_hold(report.table);
}

TEST(Thickness, of_a_clamped_dome_is_membrane_dominated) {
  problem::Problem p = pressed_bowl();
  p.shell.obstacles.all.clear();
  p.discretisation = {.degree = 4, .refinements = 2};
  const Report report = thickness(p, halvings(3), MPI_COMM_SELF, {});
  ASSERT_EQ(report.status, contact::Status::solved);
  EXPECT_NEAR(fitted(report.table, "stiffness"), 1, 0.1);
  EXPECT_GT(numbers(report.table, "membrane").back(), 95);
  expect_all_hold(report.table);
}

// A plate has shear strains e^2 times smaller than its slopes.
TEST(Thickness, of_a_plate_brings_the_rotation_to_koiters_like_its_square) {
  problem::Problem p = cantilever_plate();
  p.discretisation = {.degree = 4, .refinements = 2};
  const Report report = thickness(p, halvings(3), MPI_COMM_SELF, {});
  EXPECT_NEAR(fitted(report.table, "|r - r_K| / |r|"), 2, 0.3);
  EXPECT_NEAR(fitted(report.table, "stiffness"), 3, 0.02);
}

// Load ~ e^3 against an obstacle: displacements, and so the contact zone, have a limit.
TEST(Thickness, with_an_obstacle_keeps_the_shell_in_contact_when_the_load_goes_with_its_cube) {
  problem::Problem p = pressed_strip();
  p.discretisation = {.degree = 2, .refinements = 3};
  const Report report = thickness(p, halvings(3), MPI_COMM_SELF, {});
  ASSERT_EQ(report.status, contact::Status::solved);
  EXPECT_NEAR(numbers(report.table, "load factor").back(), 1.0 / 512, 1e-15);
  for (const auto& row : report.table.rows) EXPECT_GT(std::get<std::int64_t>(row.back()), 0);
  EXPECT_NEAR(fitted(report.table, "energy"), 3, 0.5);
}

TEST(Thickness, does_not_judge_the_stiffness_of_prescribed_motions) {
  problem::Problem p = cantilever_plate();
  p.shell.supports.push_back(
      {.boundary = "right", .components = {fixed(Unknown::displacement, Direction::z, Expression(0.1))}});
  const Report report = thickness(p, halvings(1), MPI_COMM_SELF, {});
  EXPECT_EQ(claim_on(report.table, "stiffness").verdict, Verdict::cannot_be_judged);
  EXPECT_NE(claim_on(report.table, "Koiter").verdict, Verdict::cannot_be_judged);
}

}  // namespace
}  // namespace plastron::study

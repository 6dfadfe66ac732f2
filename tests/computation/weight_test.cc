// The weight of a shell: the load rho e g per area of the mid-surface (M9), by region.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>

#include <cmath>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;
using Eigen::Vector3d;

/// A saddle of two regions, one of varying thickness, clamped at one side.
problem::Problem saddle(mesh::Shape shape) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "0.3*x*y"});
  p.domain = domain::Rectangle{.to = {1, 1}, .cells = {2, 2}, .breaks = {0.5}, .regions = {"heavy", "light"}};
  p.shell.sections.common.density = 20;
  p.shell.sections.regions["heavy"] = {.thickness = Expression("0.1 + 0.05*y", {}),
                                       .material = shell::Material::from_young_poisson(2e4, 0.2, 1),
                                       .density = 70};
  p.shell.supports = {clamped("left")};
  p.discretisation = {.cells = shape, .degree = 2, .refinements = 1};
  p.shell.tying = shape == mesh::Shape::quadrilateral;
  return p;
}

TEST(Weight, is_the_load_that_one_writes_by_hand) {
  for (const auto shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle})
    for (const auto formulation : {element::Formulation::tangent, element::Formulation::penalised,
                                   element::Formulation::mixed, element::Formulation::classical}) {
      problem::Problem p = saddle(shape), by_hand = p;
      p.shell.loads.gravity = {0.5, 0, -9.81};
      by_hand.shell.loads.on_areas = {{.force = {Expression("70 * 0.5 * (0.1 + 0.05*y)", {}), Expression(0.0),
                                                 Expression("-70 * 9.81 * (0.1 + 0.05*y)", {})},
                                       .regions = {"heavy"}},
                                      {.force = vector(20 * 0.5 * 0.1, 0, -20 * 9.81 * 0.1), .regions = {"light"}}};
      p.shell.tangency.formulation = by_hand.shell.tangency.formulation = formulation;
      const Result weighed = solve(p, MPI_COMM_WORLD), loaded = solve(by_hand, MPI_COMM_WORLD);
      EXPECT_EQ(weighed.status, contact::Status::solved) << weighed.missed_limits;
      EXPECT_GT(loaded.summary.energy.total(), 1e-3);
      EXPECT_NEAR(weighed.summary.energy.total() / loaded.summary.energy.total(), 1, 1e-11);
      EXPECT_LT((weighed.summary.loads.force - loaded.summary.loads.force).norm(),
                1e-12 * loaded.summary.loads.force.norm());
    }
}

TEST(Weight, of_a_flat_plate_is_its_mass_times_gravity) {
  problem::Problem p = cantilever_plate();
  p.shell.loads.on_areas.clear();
  p.shell.sections.common.density = 30;
  p.shell.loads.gravity = {1, 2, -3};
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_LT((result.summary.loads.force - 30 * 0.1 * Vector3d(1, 2, -3)).norm(), 1e-12);
}

TEST(Weight, without_gravity_is_nothing) {
  problem::Problem p = saddle(mesh::Shape::quadrilateral);
  EXPECT_EQ(solve(p, MPI_COMM_WORLD).summary.loads.force, Vector3d(0, 0, 0));
}

TEST(Weight, presses_a_shell_onto_the_obstacle_that_alone_holds_it) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "0.06"});
  p.shell.supports = {held("left", {Direction::x, Direction::y}), held("right", {Direction::y})};
  p.shell.obstacles.all = {obstacle::Obstacle{}};
  p.shell.sections.common.density = 1;
  EXPECT_FALSE(has_errors(examination::examine(p)));
  p.shell.loads.gravity = {0, 0, 1};
  EXPECT_TRUE(has_errors(examination::examine(p))) << "it lifts the plate off";
  p.shell.loads.gravity = {0, 0, -1};
  EXPECT_FALSE(has_errors(examination::examine(p)));
  EXPECT_NEAR(solve(p, MPI_COMM_WORLD).summary.reaction.force[2], 0.1, 1e-9);
}

}  // namespace
}  // namespace plastron::computation

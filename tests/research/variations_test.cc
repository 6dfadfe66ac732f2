// Problems with one thing changed.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <research/study/variations.hpp>

#include "computation/problems.hpp"

namespace plastron::study {
namespace {

using namespace test;

TEST(Variation, of_the_loads_scales_a_linear_solution) {
  problem::Problem p = cantilever_plate();
  p.shell.loads.on_areas.front().pressure = Expression("0.2 * x", {});
  p.shell.loads.on_areas.front().couple = vector(0, 0.1, 0);
  p.shell.loads.on_areas.front().force_function = [](double x, double y) { return Eigen::Vector3d(x, y, 1); };
  p.shell.loads.on_edges = {{.boundary = "right", .force = vector(0, 0.3, 0), .couple = vector(0.1, 0, 0)}};
  const double once = computation::solve(p, MPI_COMM_SELF).summary.energy.total();
  EXPECT_NEAR(computation::solve(with_loads_scaled(p, 3), MPI_COMM_SELF).summary.energy.total(), 9 * once, 1e-9 * once);
}

TEST(Variation, of_the_thickness_scales_bending_with_its_cube) {
  problem::Problem p = cantilever_plate();
  p.shell.sections.common.thickness = Expression("0.001 * (1 + x)", {});
  p.shell.loads.on_areas = {force(0, 0, -1e-6)};
  const double thick = computation::solve(p, MPI_COMM_SELF).summary.load_work;
  EXPECT_NEAR(computation::solve(with_thickness_scaled(p, 0.5), MPI_COMM_SELF).summary.load_work / thick, 8, 1e-2);
}

TEST(Variation, of_the_thickness_reaches_every_region_and_leaves_the_weight) {
  problem::Problem p = cantilever_plate();
  p.shell.sections.common.density = 3;
  p.shell.sections.regions["stiff"] = {
      .thickness = Expression(0.2), .material = p.shell.sections.common.material, .density = 5};
  const auto thin = with_thickness_scaled(p, 0.25).shell.sections;
  EXPECT_EQ(thin.common.thickness(0, 0), 0.025);
  EXPECT_EQ(thin.regions.at("stiff").thickness(0, 0), 0.05);
  EXPECT_EQ(thin.common.density, 12);
  EXPECT_EQ(thin.regions.at("stiff").density, 20);
}

TEST(Variation, of_the_loads_scales_the_weight) {
  problem::Problem p = cantilever_plate();
  p.shell.loads.gravity = {0, 1, -2};
  EXPECT_EQ(with_loads_scaled(p, 3).shell.loads.gravity, Eigen::Vector3d(0, 3, -6));
}

TEST(Variation, that_is_linear_and_homogeneous_keeps_what_is_held) {
  problem::Problem p = pressed_strip();
  p.shell.supports.front().components.front().value = Expression("0.1", {});
  EXPECT_TRUE(has_prescribed_motion(p));
  const problem::Problem linear = linear_and_homogeneous(p);
  EXPECT_FALSE(has_prescribed_motion(linear));
  EXPECT_TRUE(linear.shell.obstacles.empty());
  EXPECT_EQ(linear.shell.supports.size(), p.shell.supports.size());
}

TEST(Obstacle, that_is_raised_is_an_obstacle_moved_along_its_normal) {
  problem::Problem raised = pressed_strip(), moved = pressed_strip();
  raise(raised.shell.obstacles.all.at(0), 0.003);
  std::get<obstacle::HalfSpace>(moved.shell.obstacles.all.at(0).shape).point = {0, 0, 0.003};
  const auto a = computation::solve(raised, MPI_COMM_SELF), b = computation::solve(moved, MPI_COMM_SELF);
  EXPECT_NEAR(a.summary.energy.total(), b.summary.energy.total(), 1e-12 * b.summary.energy.total());
  EXPECT_EQ(a.summary.touching_nodes, b.summary.touching_nodes);
  EXPECT_GT(a.summary.touching_nodes, 0);
}

TEST(Face, keeps_its_place_when_its_scale_undoes_that_of_the_thickness) {
  problem::Problem p = with_thickness_scaled(pressed_strip(), 0.5);
  p.shell.loads.on_areas = {force(0, 0, -1e-12)};
  p.shell.obstacles.face_scale = 2;
  EXPECT_NEAR(computation::solve(p, MPI_COMM_SELF).certificate.min_gap_nodes, 0.01, 1e-8);
}

}  // namespace
}  // namespace plastron::study

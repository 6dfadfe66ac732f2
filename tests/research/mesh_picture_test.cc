// Pictures of meshes contain every cell once, the hanging vertices, and the contact zone.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <research/study/studies.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "computation/problems.hpp"

namespace plastron::study {
namespace {

using namespace test;

double area_of(const std::vector<Outline>& outlines) {
  double twice = 0;
  for (const Outline& o : outlines)
    for (std::size_t i = 0; i < o.size(); ++i) {
      const Eigen::Vector2d &a = o[i], &b = o[(i + 1) % o.size()];
      twice += a[0] * b[1] - a[1] * b[0];
    }
  return twice / 2;
}

TEST(MeshPicture, OfAUniformMeshCoversTheDomainAndHasTheContactZone) {
  for (const auto shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle}) {
    Problem p = pressed_strip();
    p.discretisation = {.cells = shape, .degree = 2, .refinements = 1};
    const computation::Result result = computation::solve(p, MPI_COMM_WORLD);
    const MeshPicture picture = mesh_picture(*result.solution);
    EXPECT_EQ(picture.cells.size(), static_cast<std::size_t>(result.last_level().cells));
    EXPECT_NEAR(area_of(picture.cells), 0.125, 1e-12);
    EXPECT_TRUE(picture.hanging.empty());
    const double zone = std::abs(area_of(picture.touching));
    EXPECT_GT(zone, 0.5 * result.summary.contact_area);  // without the half cells beyond its outermost nodes
    EXPECT_LE(zone, result.summary.contact_area);
  }
}

/// The corners of the clamped side need small cells.
Problem with_singular_corners() {
  Problem p = cantilever_plate();
  p.domain = domain::Rectangle{.cells = {4, 4}};
  p.discretisation = {.degree = 2, .refinements = 0};
  p.accuracy = problem::Accuracy{.goals = {{"energy", 3e-4}}, .max_unknowns = 8000};
  return p;
}

TEST(MeshPicture, OfAGradedMeshHasTheVerticesThatHang) {
  const computation::Result result = computation::solve(with_singular_corners(), MPI_COMM_WORLD);
  const MeshPicture picture = mesh_picture(*result.solution);
  ASSERT_FALSE(picture.hanging.empty());
  EXPECT_NEAR(area_of(picture.cells), 1, 1e-12);
  for (const Eigen::Vector2d& x : picture.hanging) {
    int touching = 0;  // two small cells have the vertex, and the large one has it in the middle of a side
    for (const Outline& cell : picture.cells)
      touching += std::ranges::any_of(cell, [&](const Eigen::Vector2d& p) { return (p - x).norm() < 1e-12; });
    EXPECT_EQ(touching, 3);
  }
}

TEST(AdaptivityStudy, DrawsTheFirstAMiddleAndTheLastMesh) {
  const Report report = adaptivity(with_singular_corners(), {}, MPI_COMM_WORLD, {});
  ASSERT_EQ(report.meshes.size(), 3u);
  EXPECT_EQ(report.meshes.front().cells.size(), 16u);
  for (std::size_t i = 1; i < 3; ++i) EXPECT_GT(report.meshes[i].cells.size(), report.meshes[i - 1].cells.size());
  EXPECT_TRUE(report.meshes.front().caption.starts_with("mesh 0: 16 cells"));
}

}  // namespace
}  // namespace plastron::study

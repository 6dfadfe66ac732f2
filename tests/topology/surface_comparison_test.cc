// The second surface of a mesh in space, with which the geometry's error is estimated.
#include <gtest/gtest.h>
#include <plastron/mesh/surface_patches.hpp>
#include <plastron/topology/surface_comparison.hpp>

#include <algorithm>
#include <cmath>

#include "domain/space_surface.hpp"

namespace plastron::topology::space_meshes {

using Eigen::Vector2d;
namespace {

mesh::CoarseMesh mesh_of(SpaceMesh mesh) {
  return *domain::space_meshes::domain_of(domain::space_meshes::surface_of(std::move(mesh))).mesh;
}

/// Largest distance of the patches from the unit sphere, at points of a lattice of order 8.
double distance_from_sphere(const mesh::SurfacePatches& surface) {
  double largest = 0;
  for (std::size_t p = 0; p < surface.patches.size(); ++p)
    for (const Vector2d& xi : mesh::lattice(surface.shape, 8)) {
      geometry::PlaneJet at;
      at.value = xi;
      at.d = {Vector2d::UnitX(), Vector2d::UnitY()};
      largest = std::max(largest, std::abs(surface.frame(static_cast<int>(p), at).phi.norm() - 1));
    }
  return largest;
}

TEST(SurfaceComparison, FindsTheDistanceOfCellsFromASphere) {
  for (const int order : {1, 2}) {
    const mesh::CoarseMesh mesh = mesh_of(sphere(mesh::Shape::quadrilateral, 8, order));
    const SurfaceComparison second = compared_surface(mesh, {});
    const double distance = distance_from_sphere(*mesh.patches);
    EXPECT_NEAR(second.deviation, distance, 0.3 * distance) << order;
    EXPECT_LT(distance_from_sphere(*second.patches), 0.3 * distance) << order;
    EXPECT_GT(second.judged_share, 0.99);
    EXPECT_EQ(second.decay, 1);
  }
}

TEST(SurfaceComparison, ExtrapolatesTheDecayOfHighOrders) {
  for (const int order : {3, 4}) {
    const mesh::CoarseMesh mesh = mesh_of(sphere(mesh::Shape::quadrilateral, 4, order));
    const SurfaceComparison second = compared_surface(mesh, {});
    const double distance = distance_from_sphere(*mesh.patches);
    EXPECT_GT(second.deviation, 0.1 * distance) << order;
    EXPECT_LT(second.deviation, 10 * distance) << order;
    EXPECT_GT(distance_from_sphere(*second.patches), distance);
    EXPECT_LT(second.decay, 0.1);
  }
}

TEST(SurfaceComparison, LeavesPlanesAndTheirFoldsAlone) {
  for (const mesh::Shape shape : shapes)
    for (const int order : {1, 2, 3}) {
      const SurfaceComparison second = compared_surface(mesh_of(cube(shape, 4, order)), {});
      EXPECT_LT(second.deviation, 1e-14);
    }
}

/// A quarter of a tube between two planes: the curvature jumps between 0 and 1.
SpaceMesh gutter(int cells) {
  SpaceMesh mesh{.shape = mesh::Shape::quadrilateral, .nodes = {}, .cells = {}};
  const double half = std::acos(0.0) / 2, end = std::sin(half), top = std::cos(half);
  const Grid grid{.columns = cells, .rows = 4, .order = 2};
  add_grid(grid, plate({-end - top, 0, top - end}, {top, 0, end}, {0, 1, 0}), mesh);
  add_grid(
      grid,
      [&](double s, double t) {
        const double angle = half * (2 * s - 1);
        return Vector3d(std::sin(angle), t, std::cos(angle));
      },
      mesh);
  add_grid(grid, plate({end, 0, top}, {top, 0, -end}, {0, 1, 0}), mesh);
  return glued(std::move(mesh));
}

// The distance of a parabola from the circle is (h/2)^4 / 32. A fit across the jump finds a hundredth of h^2.
TEST(SurfaceComparison, FitsNotAcrossJumpsOfTheCurvature) {
  const int cells = 6;
  const double h = std::acos(0.0) / cells, distance = std::pow(h / 2, 4) / 32;
  const SurfaceComparison second = compared_surface(mesh_of(gutter(cells)), {});
  EXPECT_LT(second.deviation, 2 * distance);
  EXPECT_GT(second.deviation, distance / 2);
  EXPECT_GT(second.judged_share, 0.8);
}

TEST(SurfaceDirectors, OfATubeAreRadialAtItsEdges) {
  for (const int order : {2, 3, 4})
    for (const int cells : {3, 6}) {
      SpaceMesh tube{.shape = mesh::Shape::quadrilateral, .nodes = {}, .cells = {}};
      const auto point = [](double s, double t) { return Vector3d(std::cos(s * pi / 2), std::sin(s * pi / 2), t); };
      add_grid({.columns = cells, .rows = 2, .order = order}, point, tube);
      const domain::FileSurface surface = domain::space_meshes::surface_of(glued(std::move(tube)));
      int ends = 0;
      for (const DirectorNode& node : surface.topology.director_nodes) {
        const Vector3d& place = surface.topology.mesh.nodes[static_cast<std::size_t>(node.node)];
        if (place[0] > 1e-9 && place[1] > 1e-9) continue;
        EXPECT_NEAR(node.director[0] * place[1] - node.director[1] * place[0], 0, 1e-6) << order << ' ' << cells;
        ++ends;
      }
      EXPECT_EQ(ends, 2 * (2 * order + 1));
    }
}

}  // namespace
}  // namespace plastron::topology::space_meshes

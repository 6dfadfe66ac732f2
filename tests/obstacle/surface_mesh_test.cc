#include "obstacle/probing.hpp"

#include <plastron/obstacle/surface_mesh.hpp>

#include <numbers>

namespace plastron::obstacle {
namespace {

const Extent all{Vector3d(-2, -2, -2), Vector3d(2, 2, 2)};

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm() / 2;
  return sum;
}

TEST(ADrawnSurface, LiesOnTheObstacleAndLooksToTheFreeSide) {
  const std::vector<Shape> shapes{
      Ball{{0.1, 0, 0}, 0.05},
      Ball{.radius = 1, .inside = true},
      Cylinder{.radius = 0.5},
      Torus{},
      Box{},
      HeightField(std::make_shared<const geometry::SpaceFunction>("0.2*cos(X)*Y", geometry::Constants{}))};
  for (const Shape& shape : shapes) {
    Obstacle body{.shape = shape};
    body.placement = placed({0, 1, 0}, 0.4, {0, 0, 0}, {0.2, 0, 0.2});
    const TriangleMesh mesh = surface_mesh(body, all, 16);
    EXPECT_GT(mesh.triangles.size(), 100u);
    for (const Vector3d& p : mesh.points) EXPECT_NEAR(body.nearest(p).distance, 0, 1e-8);
    std::size_t turned = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vector3d &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c], middle = (p + q + r) / 3;
      const Vector3d normal = (q - p).cross(r - p);
      if (normal.norm() > 1e-6 && normal.dot(body.nearest(middle).normal) < 0) ++turned;
    }
    EXPECT_EQ(turned, 0u);
  }
}

TEST(ADrawnBall, HasTheAreaOfTheBall) {
  EXPECT_NEAR(area(surface_mesh({.shape = Ball{}}, all, 32)), 4 * std::numbers::pi, 0.05);
  EXPECT_TRUE(surface_mesh({.shape = Ball{{9, 9, 9}, 1}}, all).triangles.empty());
}

TEST(ADrawnHalfSpace, IsARectangle) {
  const TriangleMesh mesh = surface_mesh({.shape = HalfSpace{{0, 0, 1}, {0.6, 0, 0.8}}}, all);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  for (const Vector3d& p : mesh.points) EXPECT_NEAR((p - Vector3d(0, 0, 1)).dot(Vector3d(0.6, 0, 0.8)), 0, 1e-14);
}

}  // namespace
}  // namespace plastron::obstacle

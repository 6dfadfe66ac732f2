#include "obstacle/probing.hpp"

#include <numbers>

namespace plastron::obstacle {
namespace {

const Vector3d tilted = Vector3d(1, -2, 2) / 3;

Matrix3d turned() { return Eigen::AngleAxisd(0.7, tilted).toRotationMatrix(); }

/// All shapes in the unit of length `m`.
std::vector<Shape> shapes(double m = 1) {
  const Vector3d at = m * Vector3d(0.1, -0.2, 0.15);
  return {
      HalfSpace{at, tilted},
      Ball{at, 0.6 * m},
      Ball{at, 0.6 * m, true},
      Cylinder{.point = at, .axis = tilted, .radius = 0.5 * m},
      Cylinder{.point = at, .axis = tilted, .radius = 0.5 * m, .length = 1.2 * m},
      Cylinder{.point = at, .axis = tilted, .radius = 0.5 * m, .length = 1.2 * m, .inside = true, .fillet = 0.2 * m},
      Cylinder{.point = at, .axis = tilted, .radius = 0.4 * m, .length = 1.2 * m, .fillet = 0.4 * m},
      Box{at, m * Vector3d(1, 0.8, 0.5), turned()},
      Box{at, m * Vector3d(1, 0.8, 0.5), turned(), 0.2 * m},
      Torus{at, tilted, 0.7 * m, 0.2 * m},
      Cone{.apex = at, .axis = tilted, .half_angle = 0.5},
      Cone{.apex = at, .axis = tilted, .half_angle = 0.8, .height = 0.9 * m},
      Cone{.apex = at, .axis = tilted, .half_angle = 0.6, .height = 0.9 * m, .fillet = 0.1 * m}};
}

TEST(AnalyticShapes, HaveExactDerivatives) {
  for (const Shape& shape : shapes()) test::expect_exact_derivatives(shape, test::random_points(500, 1.5), 1, 4);
}

TEST(AnalyticShapes, HaveNoSurfaceNearerThanTheirDistance) {
  for (const Shape& shape : shapes()) test::expect_true_distance(shape, test::random_points(100, 1.5), 1);
}

TEST(AnalyticShapes, AreTheSameInMicrometresAndInMegametres) {
  const auto points = test::random_points(100, 1.5);
  for (const double m : {1e-6, 1e6})
    for (std::size_t k = 0; k < shapes().size(); ++k)
      for (const Vector3d& X : points) {
        const Nearest one = Obstacle{.shape = shapes()[k]}.nearest(X),
                      other = Obstacle{.shape = shapes(m)[k]}.nearest(m * X);
        EXPECT_NEAR(other.distance / m, one.distance, 1e-13);
        EXPECT_LT((other.normal - one.normal).norm(), 1e-11);
        EXPECT_LT((other.curvature * m - one.curvature).norm(), 1e-10 * (1 + std::pow(one.curvature.norm(), 2)));
      }
}

TEST(ACapsule, IsSmoothOnItsAxis) {
  const Cylinder capsule{.radius = 0.5, .length = 3, .fillet = 0.5};
  const Nearest tip = capsule.nearest({0, 0, 2});
  EXPECT_DOUBLE_EQ(tip.distance, 0.5);
  EXPECT_LT((tip.curvature - Ball{{0, 0, 1}, 0.5}.nearest({0, 0, 2}).curvature).norm(), 1e-15);
}

TEST(ABoxAllFillet, IsABall) {
  const Box box{.size = {2, 2, 2}, .fillet = 1};
  for (const Vector3d& X : test::random_points(50, 2)) {
    EXPECT_NEAR(box.nearest(X).distance, Ball{}.nearest(X).distance, 1e-15);
    EXPECT_LT((box.nearest(X).curvature - Ball{}.nearest(X).curvature).norm(), 1e-12);
  }
}

TEST(AFlatCone, TouchesTheLargestBallInside) {
  const Cone cone{.half_angle = std::numbers::pi / 6, .height = 3};
  EXPECT_NEAR(cone.largest_fillet(), 1, 1e-15);
  EXPECT_NEAR(cone.nearest({0, 0, 2}).distance, -1, 1e-15);
}

}  // namespace
}  // namespace plastron::obstacle

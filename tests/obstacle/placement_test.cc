#include "obstacle/probing.hpp"

namespace plastron::obstacle {
namespace {

TEST(APlacement, TurnsAndShiftsTheShapeAndLeavesDistances) {
  const Vector3d axis = Vector3d(2, -1, 2) / 3, about(0.3, 0.1, -0.2), shift(0.4, 0.5, -0.6);
  const Obstacle rest{.shape = Box{.size = {1, 0.7, 0.4}, .fillet = 0.1}};
  Obstacle body = rest;
  body.placement = placed(axis, 1.1, about, shift);
  body.translation = {0, 0, 2};
  const Matrix3d R = Eigen::AngleAxisd(1.1, axis).toRotationMatrix();
  for (const Vector3d& x : test::random_points(100, 1)) {
    const Vector3d X = about + R * (x - about) + shift + 0.5 * body.translation;
    const Nearest at = body.nearest(X, 0.5), at_rest = rest.nearest(x, 0);
    EXPECT_NEAR(at.distance, at_rest.distance, 1e-14);
    EXPECT_LT((at.normal - R * at_rest.normal).norm(), 1e-12);
    EXPECT_LT((at.curvature - R * at_rest.curvature * R.transpose()).norm(), 1e-10 * (1 + at.curvature.norm()));
  }
}

TEST(APlacement, OfNothingChangesNoBit) {
  Obstacle body{.shape = HalfSpace{{0.1, 0.2, 0.3}, Vector3d(0.6, 0, 0.8)}};
  body.placement = placed({0, 0, 1}, 0, {5, 6, 7}, Vector3d::Zero());
  for (const Vector3d& X : test::random_points(50, 1))
    EXPECT_EQ(body.nearest(X, 0).distance, std::get<HalfSpace>(body.shape).nearest(X).distance);
}

}  // namespace
}  // namespace plastron::obstacle

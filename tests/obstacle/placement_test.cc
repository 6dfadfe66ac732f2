#include "obstacle/probing.hpp"

#include <numbers>

namespace plastron::obstacle {
namespace {

TEST(APlacement, TurnsAndShiftsTheShapeAndLeavesDistances) {
  const Vector3d axis = Vector3d(2, -1, 2) / 3, about(0.3, 0.1, -0.2), shift(0.4, 0.5, -0.6);
  const Obstacle rest{.shape = Box{.size = {1, 0.7, 0.4}, .fillet = 0.1}};
  Obstacle body = rest;
  body.placement = placed(axis, 1.1, about, shift);
  const Matrix3d R = Eigen::AngleAxisd(1.1, axis).toRotationMatrix();
  for (const Vector3d& x : test::random_points(100, 1)) {
    const Vector3d X = about + R * (x - about) + shift;
    const Nearest at = body.nearest(X), at_rest = rest.nearest(x);
    EXPECT_NEAR(at.distance, at_rest.distance, 1e-14);
    EXPECT_LT((at.normal - R * at_rest.normal).norm(), 1e-12);
    EXPECT_LT((at.curvature - R * at_rest.curvature * R.transpose()).norm(), 1e-10 * (1 + at.curvature.norm()));
  }
}

TEST(APlacement, OfNothingChangesNoBit) {
  Obstacle body{.shape = HalfSpace{{0.1, 0.2, 0.3}, Vector3d(0.6, 0, 0.8)}};
  body.placement = placed({0, 0, 1}, 0, {5, 6, 7}, Vector3d::Zero());
  for (const Vector3d& X : test::random_points(50, 1))
    EXPECT_EQ(body.nearest(X).distance, std::get<HalfSpace>(body.shape).nearest(X).distance);
}

TEST(AMotion, RunsThroughItsStepsOneAfterTheOther) {
  // A quarter turn about z through (1, 0, 0), then 2 along x.
  const Obstacle body{.shape = Ball{{2, 0, 0}, 0.5},
                      .motions = {{.angle = std::numbers::pi / 2, .about = {1, 0, 0}}, {.translation = {2, 0, 0}}}};
  const auto distance_of_centre = [&](double time, const Vector3d& centre) {
    return body.standing(time).nearest(centre).distance;
  };
  const double s = std::sqrt(0.5);
  EXPECT_NEAR(distance_of_centre(0, {2, 0, 0}), -0.5, 1e-15);
  EXPECT_NEAR(distance_of_centre(0.5, {1 + s, s, 0}), -0.5, 1e-15);
  EXPECT_NEAR(distance_of_centre(1, {1, 1, 0}), -0.5, 1e-15);
  EXPECT_NEAR(distance_of_centre(1.25, {1.5, 1, 0}), -0.5, 1e-15);
  EXPECT_NEAR(distance_of_centre(7, {3, 1, 0}), -0.5, 1e-15);
}

TEST(APressedBody, ComesAlongItsForce) {
  const Obstacle body{.shape = Ball{}, .force = {0, 0, -3}};
  EXPECT_TRUE(body.is_pressed());
  EXPECT_NEAR(body.standing(0, 0.25).nearest({0, 0, -2}).distance, 0.75, 1e-15);
}

}  // namespace
}  // namespace plastron::obstacle

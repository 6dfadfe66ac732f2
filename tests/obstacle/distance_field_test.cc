#include "obstacle/probing.hpp"

#include <plastron/obstacle/error.hpp>

namespace plastron::obstacle {
namespace {

DistanceField field(const std::string& text, const geometry::Constants& constants = {}) {
  return DistanceField(std::make_shared<const geometry::SpaceFunction>(text, constants));
}

TEST(ADistanceExpression, OfAPlaneIsTheHalfSpace) {
  const HalfSpace plane{{0, 0, 0.5}, {0.6, 0, 0.8}};
  for (const Vector3d& X : test::random_points(100, 2)) {
    EXPECT_NEAR(field("0.6*X + 0.8*(Z - 0.5)").nearest(X).distance, plane.nearest(X).distance, 1e-15);
    EXPECT_NEAR(field("6*X + 8*(Z - 0.5)").nearest(X).distance, plane.nearest(X).distance, 1e-14);
  }
}

TEST(AnExpressionThatIsNoDistance, GivesTheDistanceToItsZeroSet) {
  const Ball ball{{0, 0, 0.2}, 0.7};
  const DistanceField square = field("X^2 + Y^2 + (Z - 0.2)^2 - 0.49");
  for (const Vector3d& X : test::random_points(200, 1.5)) {
    const Nearest at = square.nearest(X), exact = ball.nearest(X);
    EXPECT_NEAR(at.distance, exact.distance, 1e-13);
    EXPECT_LT((at.normal - exact.normal).norm(), 1e-12);
    EXPECT_LT((at.curvature - exact.curvature).norm(), 1e-10 * (1 + exact.curvature.squaredNorm()));
  }
}

TEST(AnEllipsoid, HasExactDerivativesAndNoSurfaceNearer) {
  const DistanceField ellipsoid = field("X^2 + (Y/0.8)^2 + (Z/0.6)^2 - 1");
  std::vector<Vector3d> points;
  for (const Vector3d& X : test::random_points(400, 1.5))
    if (ellipsoid.level(X) > -0.4) points.push_back(X);
  test::expect_exact_derivatives(ellipsoid, points, 1, 2);
  test::expect_true_distance(ellipsoid, points, 1);
}

TEST(ADistanceExpression, IsTheSameInMicrometresAndInMegametres) {
  for (const double m : {1e-6, 1e6})
    for (const Vector3d& X : test::random_points(50, 1.5))
      EXPECT_NEAR(field("X^2 + Y^2 + 2*Z^2 - m^2", {{"m", m}}).nearest(m * (X + Vector3d(0, 0, 2))).distance / m,
                  field("X^2 + Y^2 + 2*Z^2 - 1").nearest(X + Vector3d(0, 0, 2)).distance, 1e-12);
}

TEST(ADistanceExpression, WithoutGradientIsRefused) {
  EXPECT_THROW(field("3"), ObstacleError);
  EXPECT_THROW(field("Z^2").nearest({0, 0, 0}), ObstacleError);
  EXPECT_THROW(field("Z^2").nearest({0, 0, 1}), ObstacleError);
  EXPECT_THROW(field("Z^2 + 1").nearest({0, 0, 1}), ObstacleError);
}

}  // namespace
}  // namespace plastron::obstacle

#include "obstacle/probing.hpp"

#include <plastron/geometry/given_function.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/obstacle.hpp>

#include <gmock/gmock.h>

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

/// Points of the surface along 10 000 directions from the origin, from which the whole surface is visible.
class StarShaped {
 public:
  explicit StarShaped(const DistanceField& body) : body_(body) {
    constexpr int count = 10000;
    for (int i = 0; i < count; ++i) {
      const double z = (2.0 * i + 1) / count - 1, turn = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
      directions_.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
      points_.push_back(at(directions_.back()));
    }
  }

  /// The nearest of these points, then of others around it with steps of half the length.
  double distance(const Vector3d& X) const {
    std::size_t first = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if ((X - points_[i]).squaredNorm() < (X - points_[first]).squaredNorm()) first = i;
    Vector3d best = directions_[first];
    double least = (X - points_[first]).norm();
    for (double step = 0.04; step > 1e-8; step /= 2)
      for (int i = 0; i < 26; ++i) {
        const Vector3d way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), trial = (best + step * way).normalized();
        if (const double d = (X - at(trial)).norm(); d < least) least = d, best = trial, i = -1;
      }
    return least;
  }

 private:
  Vector3d at(const Vector3d& direction) const {
    double low = 0, high = 4;
    for (int i = 0; i < 50; ++i) {
      const double middle = (low + high) / 2;
      (body_.level(middle * direction) < 0 ? low : high) = middle;
    }
    return low * direction;
  }

  const DistanceField& body_;
  std::vector<Vector3d> directions_, points_;
};

TEST(ADistanceExpression, GivesTheDistanceOfBruteForceInsideAndOutside) {
  for (const char* text :
       {"X^2 + 2*Y^2 + Z^2 - 1", "X^2 + (Y/0.3)^2 + (Z/2)^2 - 1", "X^4 + Y^4 + Z^4 - 1", "X^6 + 3*Y^6 + Z^6 - 1",
        "(X^2+Y^2+Z^2)^2 - 2*(X^2-Y^2-Z^2) - 0.2", "X^2 + Y^2 + Z^2 - 1 + 0.3*sin(5*X)*sin(4*Y)*cos(3*Z)"}) {
    const DistanceField body = field(text);
    const StarShaped exact(body);
    for (const Vector3d& X : test::random_points(150, 1.2)) {
      const Nearest at = body.nearest(X);
      EXPECT_NEAR(std::abs(at.distance), exact.distance(X), 1e-6) << text << " at " << X.transpose();
      EXPECT_EQ(at.distance < 0, body.level(X) < 0) << text << " at " << X.transpose();
      EXPECT_NEAR(body.nearest(X - at.distance * at.normal).distance, 0, 1e-9) << text << " at " << X.transpose();
    }
  }
}

/// The foot of an ellipsoid with half axes a has the coordinates a_i^2 X_i / (t + a_i^2); outside t > 0 is the zero of a falling function.
double distance_from_ellipsoid(const Vector3d& a, const Vector3d& X) {
  double low = 0, high = a.maxCoeff() * X.norm();
  const auto foot = [&](double t) {
    return Vector3d(a.cwiseAbs2().cwiseProduct(X).cwiseQuotient((a.cwiseAbs2().array() + t).matrix()));
  };
  for (int i = 0; i < 200; ++i) {
    const double t = (low + high) / 2;
    (foot(t).cwiseQuotient(a).squaredNorm() > 1 ? low : high) = t;
  }
  return (X - foot(low)).norm();
}

/// They are smaller than the angles between the directions of a search.
TEST(ADistanceExpression, FindsSlenderBodiesFromFarAway) {
  const std::vector<Vector3d> axes = test::random_points(12, 1), places = test::random_points(12, 3);
  for (const Vector3d& axis : axes)
    for (const Vector3d& X : places) {
      const Vector3d a = axis.cwiseAbs().cwiseMax(0.02);
      if (X.cwiseQuotient(a).norm() < 1.1) continue;
      const double found =
          field("(X/a)^2 + (Y/b)^2 + (Z/c)^2 - 1", {{"a", a[0]}, {"b", a[1]}, {"c", a[2]}}).nearest(X).distance;
      EXPECT_NEAR(found, distance_from_ellipsoid(a, X), 1e-6) << a.transpose() << " from " << X.transpose();
    }
}

/// Newton's method ends between two feet there.
TEST(ADistanceExpression, KnowsAPointDeepInsideOfAnEllipsoid) {
  const DistanceField ellipsoid = field("X^2 + 2*Y^2 + Z^2 - 1");
  const Vector3d X(0.397554, 0.0425161, 0.257049);
  EXPECT_NEAR(ellipsoid.nearest(X).distance, -StarShaped(ellipsoid).distance(X), 1e-7);
}

/// Far away the gradient of a high power is as many times greater than at the surface.
TEST(ADistanceExpression, OfHighPowersIsKnownFarAway) {
  EXPECT_NEAR(field("X^8 + Y^8 + Z^8 - 1").nearest({0, 0, 20}).distance, 19, 1e-9);
}

/// F is zero only up to the rounding of its terms, which are much greater than X.
TEST(ADistanceExpression, IsKnownNextToItsSurfaceAtTheOrigin) {
  for (const char* text : {"X^2 + Y^2 + Z^2 - 2*Z", "X^2 + Y^2 + (Z - 1)^2 - 1", "sqrt(X^2 + Y^2 + (Z - 1)^2) - 1",
                           "X^2 + Y^2 + (Z - 1000)^2 - 1e6", "1 - cos(X) + Y^2 + 3 - exp(2*Z) - 2"})
    for (const double size : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15})
      for (const Vector3d& X : test::random_points(40, size)) {
        const double distance = field(text).nearest(X).distance;
        EXPECT_NEAR(distance, -X[2], 3 * size * size + 2e-13) << text << " at " << X.transpose();
      }
}

/// A slab: its two faces are one zero set, and the gradient jumps between them.
TEST(AKinkOfADistanceExpression, DoesNoHarmOffTheSurface) {
  const DistanceField slab = field("abs(Z) - 0.1");
  for (Vector3d X : test::random_points(200, 0.3)) {
    const Nearest at = slab.nearest(X);
    EXPECT_NEAR(at.distance, std::abs(X[2]) - 0.1, 1e-15);
    EXPECT_EQ(at.normal, Vector3d(0, 0, X[2] > 0 ? 1 : -1));
  }
  EXPECT_THROW(slab.nearest({0.3, 0.2, 0}), ObstacleError);
  // Next to a face of an octahedron, away from its edges.
  EXPECT_NEAR(field("abs(X) + abs(Y) + abs(Z) - 1").nearest({0.4, 0.4, 0.4}).distance, 0.2 / std::sqrt(3), 1e-14);
}

std::string refusal(const Obstacle& obstacle, const Vector3d& X) {
  try {
    obstacle.nearest(X);
  } catch (const ObstacleError& error) {
    return error.what();
  }
  return "";
}

TEST(ARefusedDistance, NamesTheObstacleThePointAndTheReason) {
  const auto said = [](const char* text, const Vector3d& X) {
    return refusal({.name = "pin", .shape = field(text)}, X);
  };
  EXPECT_EQ(said("Z^2 + 1", {0, 0, 1}),
            "the obstacle \"pin\" at the point (0, 0, 1) of space: the distance expression \"Z^2 + 1\" is 2 there and "
            "has that sign as far as 1.02e+03 m away: no surface of a body is near; the body is where it is negative, "
            "and it must change its sign at the surface (are its constants and lengths right?)");
  EXPECT_THAT(said("Z^2", {0, 0, 1}), testing::HasSubstr("has a zero gradient where it is zero itself"));
  EXPECT_THAT(said("abs(Z) - 0.1", {0, 2, 0}), testing::HasSubstr("is -0.1 and has a zero gradient there"));
  EXPECT_THAT(said("log(Z)", {0, 0, -1}), testing::HasSubstr("is not finite there"));
  EXPECT_THAT(said("abs(X) + abs(Y) + abs(Z) - 1", {0.1, 0.2, 2}), testing::HasSubstr("without kinks there"));
  const Obstacle shifted{.shape = field("Z^2 + 1"), .placement = {.translation = {0, 0, 3}}};
  EXPECT_THAT(refusal(shifted, {0, 0, 4}),
              testing::StartsWith("the obstacle at the point (0, 0, 4) of space, (0, 0, 1) in its own coordinates: "));
}

/// A wavy die, as text and as a given function that counts its calls.
struct CountedDie {
  static constexpr const char* text = "Z + 0.03 - 0.008*cos(6*X)*cos(6*Y)";
  const std::string name = "counted_die";
  std::shared_ptr<const geometry::SpaceFunction> formula =
      std::make_shared<const geometry::SpaceFunction>(text, geometry::Constants{});
  std::size_t calls = 0, places = 0;

  CountedDie() {
    geometry::give_function(
        name, {.uses_space = true,
               .depends_on = {true, true, true},
               .evaluate = [this](std::span<const geometry::Place> at, int first, int count, std::span<double> values) {
                 ++calls, places += at.size();
                 for (std::size_t i = 0; i < at.size(); ++i) {
                   const geometry::SpaceJet f = (*formula)({at[i].X, at[i].Y, at[i].Z});
                   const std::array<double, 10> all{f.value,         f.gradient[0],   f.gradient[1],   f.gradient[2],
                                                    f.hessian(0, 0), f.hessian(0, 1), f.hessian(0, 2), f.hessian(1, 1),
                                                    f.hessian(1, 2), f.hessian(2, 2)};
                   for (int k = 0; k < count; ++k)
                     values[static_cast<std::size_t>(k) * at.size() + i] = all[static_cast<std::size_t>(first + k)];
                 }
               }});
  }
  CountedDie(const CountedDie&) = delete;
  CountedDie& operator=(const CountedDie&) = delete;
  ~CountedDie() { geometry::forget_function(name); }
};

/// A function of a program in Python takes as long for a point as for a thousand.
TEST(AGivenDistance, IsCalledForManyPointsTogether) {
  CountedDie die;
  const DistanceField given = field(die.name), formula = field(CountedDie::text);
  std::vector<Vector3d> points = test::random_points(1000, 1);
  for (Vector3d& X : points) X[2] *= 0.1;
  Obstacle body{.shape = given};
  body.placement = placed({0, 0, 1}, 0.3, {0, 0, 0}, {0.1, 0.2, 0.3});
  std::vector<Vector3d> moved;
  for (const Vector3d& X : points) moved.push_back(body.placement.to_space(X));
  body.prepare(moved);
  EXPECT_LT(die.calls, 60u);
  EXPECT_GT(die.places / die.calls, 1000u);
  const std::size_t calls = die.calls;
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(body.nearest(moved[i]).distance, formula.nearest(points[i]).distance, 1e-14);
  EXPECT_EQ(die.calls, calls) << "prepared distances are known";
}

TEST(ADistanceExpression, TakesFewEvaluationsNearItsSurface) {
  CountedDie die;
  const DistanceField given = field(die.name);
  const std::vector<Vector3d> points = test::random_points(200, 0.02);
  for (const Vector3d& X : points) given.nearest(X);
  EXPECT_LT(static_cast<double>(die.places) / static_cast<double>(points.size()), 100);
  const std::size_t places = die.places;
  for (const Vector3d& X : points) given.nearest(X);
  EXPECT_EQ(die.places, places) << "distances are kept";
}

TEST(ADistanceExpression, WithoutGradientIsRefused) {
  EXPECT_THROW(field("3"), ObstacleError);
  EXPECT_THROW(field("Z^2").nearest({0, 0, 0}), ObstacleError);
  EXPECT_THROW(field("Z^2").nearest({0, 0, 1}), ObstacleError);
  EXPECT_THROW(field("Z^2 + 1").nearest({0, 0, 1}), ObstacleError);
}

}  // namespace
}  // namespace plastron::obstacle

#include "obstacle/probing.hpp"

#include <plastron/obstacle/error.hpp>

#include <filesystem>
#include <fstream>
#include <numbers>

namespace plastron::obstacle {
namespace {

HeightField height(const std::string& text, const geometry::Constants& constants = {}) {
  return HeightField(std::make_shared<const geometry::SpaceFunction>(text, constants));
}

TEST(AHeightFieldOfZero, IsTheHalfSpaceExactly) {
  for (const Vector3d& X : test::random_points(100, 3)) {
    const Nearest at = height("0").nearest(X), plane = HalfSpace{}.nearest(X);
    EXPECT_EQ(at.distance, plane.distance);
    EXPECT_EQ(at.normal, plane.normal);
    EXPECT_EQ(at.curvature, plane.curvature);
  }
}

TEST(ASlope, IsAHalfSpace) {
  const HeightField slope = height("0.5*X - 0.25*Y + 1");
  const HalfSpace plane{{0, 0, 1}, Vector3d(-0.5, 0.25, 1).normalized()};
  for (const Vector3d& X : test::random_points(100, 3))
    EXPECT_NEAR(slope.nearest(X).distance, plane.nearest(X).distance, 1e-14);
}

TEST(AWavyFloor, HasExactDerivatives) {
  std::vector<Vector3d> points = test::random_points(300, 0.5);
  for (Vector3d& X : points) X[2] = 0.3 * X[2];
  test::expect_exact_derivatives(height("0.05*cos(4*X)*sin(3*Y)"), points, 1, 2);
}

// The foot among 200 000 points of the curve, whose spacing bounds the error.
TEST(AWavyFloor, IsAsFarAsBruteForceSays) {
  const double A = 0.05, k = 6 * std::numbers::pi;
  const HeightField wave = height("A*cos(k*X)", {{"A", A}, {"k", k}});
  for (const Vector3d& at : test::random_points(60, 0.4)) {
    const Vector3d X(at[0], at[1], 0.5 * (at[2] + 0.4) + A * std::cos(k * at[0]) * (at[2] > 0 ? 0 : 1));
    double least = 1e300;
    constexpr int count = 200000;
    for (int i = 0; i <= count; ++i) {
      const double x = X[0] - 1 + 2.0 * i / count;
      least = std::min(least, std::hypot(x - X[0], A * std::cos(k * x) - X[2]));
    }
    EXPECT_NEAR(std::abs(wave.nearest(X).distance), least, 1e-9 + 1e-10 / std::max(least, 1e-5)) << X.transpose();
    EXPECT_EQ(wave.nearest(X).distance < 0, wave.level(X) < 0);
  }
}

struct Waves {
  const char* text;
  double (*height)(double, double);
  double low, high;  // number of points from which the distance is computed
};

/// The least distance to 250 x 250 points of the graph within that distance, then with steps of half the length.
double brute_force(const Waves& waves, const Vector3d& X) {
  const double reach = std::abs(waves.height(X[0], X[1]) - X[2]);
  const auto distance = [&](const Eigen::Vector2d& p) {
    return std::hypot(p[0] - X[0], p[1] - X[1], waves.height(p[0], p[1]) - X[2]);
  };
  Eigen::Vector2d best = X.head<2>();
  double least = reach;
  const auto look_at = [&](const Eigen::Vector2d& p) {
    const double d = distance(p);
    if (d < least) least = d, best = p;
    return best == p;
  };
  constexpr int count = 125;
  for (int i = -count; i <= count; ++i)
    for (int j = -count; j <= count; ++j) look_at(X.head<2>() + reach / count * Eigen::Vector2d(i, j));
  for (double step = reach / count; step > 1e-9; step /= 2)
    for (int i = 0; i < 8; ++i)
      if (look_at(best + step * Eigen::Vector2d(std::cos(i * 0.7854), std::sin(i * 0.7854)))) i = -1;
  return least;
}

// The foot is on the graph, so no distance can be too small.
TEST(WavesOfAllKinds, HaveNoPointThatIsNearerThanTheFoot) {
  using std::cos, std::sin, std::exp;
  const std::array<Waves, 6> all{
      {{"0.02*cos(40*X)*cos(30*Y)", [](double x, double y) { return 0.02 * cos(40 * x) * cos(30 * y); }, -1, 1},
       {"0.05*cos(60*X)*cos(50*Y)", [](double x, double y) { return 0.05 * cos(60 * x) * cos(50 * y); }, 1, 2},
       {"0.3*cos(20*X)*cos(15*Y)", [](double x, double y) { return 0.3 * cos(20 * x) * cos(15 * y); }, -0.6, 0.6},
       {"0.1*cos(9*X)*cos(8*Y)+0.05*sin(17*X-15*Y)+0.4*X",
        [](double x, double y) { return 0.1 * cos(9 * x) * cos(8 * y) + 0.05 * sin(17 * x - 15 * y) + 0.4 * x; }, -1,
        1},
       {"0.4*exp(-30*(X^2+Y^2))", [](double x, double y) { return 0.4 * exp(-30 * (x * x + y * y)); }, -0.5, 1},
       {"0.2*cos(6.283185307179586*16*X)", [](double x, double) { return 0.2 * cos(6.283185307179586 * 16 * x); }, -0.5,
        0.5}}};
  for (const Waves& waves : all) {
    const HeightField field = height(waves.text);
    for (Vector3d X : test::random_points(40, 0.7)) {
      X[2] = waves.low + (waves.high - waves.low) * (X[2] / 1.4 + 0.5);
      const Nearest at = field.nearest(X);
      const Vector3d foot = X - at.distance * at.normal;
      EXPECT_NEAR(foot[2], waves.height(foot[0], foot[1]), 1e-12) << waves.text << " at " << X.transpose();
      EXPECT_LT(std::abs(at.distance), brute_force(waves, X) + 1e-9) << waves.text << " at " << X.transpose();
      EXPECT_EQ(at.distance < 0, field.level(X) < 0);
    }
  }
}

TEST(AHeightField, AnswersTheSameInWhateverOrderItIsAsked) {
  const char* text = "0.1*cos(9*X)*cos(8*Y)+0.05*sin(17*X-15*Y)";
  const auto points = test::random_points(300, 1);
  const HeightField forward = height(text), backward = height(text);
  std::vector<Nearest> first;
  for (const Vector3d& X : points) first.push_back(forward.nearest(X));
  for (std::size_t i = points.size(); i-- > 0;) {
    const Nearest again = backward.nearest(points[i]);
    EXPECT_EQ(again.distance, first[i].distance);
    EXPECT_EQ(again.normal, first[i].normal);
    EXPECT_EQ(again.curvature, first[i].curvature);
  }
}

/// If the foot is X itself up to rounding, it is still found.
TEST(AHeightField, KnowsTheDistanceOfPointsOnIt) {
  const HeightField field = height("0.1*cos(6*X)*cos(6*Y)");
  for (Vector3d X : test::random_points(2000, 1))
    for (const double off : {0.0, 1e-16, 1e-13, 1e-10, 1e-8}) {
      X[2] = 0.1 * std::cos(6 * X[0]) * std::cos(6 * X[1]) + off;
      EXPECT_NEAR(field.nearest(X).distance, off, 1e-15 + 0.2 * off);
    }
}

/// Narrow ridges have steep flanks, on which rounding of X and Y is rounding of the height times the slope.
TEST(AHeightField, KnowsTheDistanceOfPointsOnTheFlanksOfNarrowRidges) {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int k = 0; k < 60; ++k) {
    const double high = std::pow(10, between(-2.5, -0.5)), width = high / std::pow(10, between(0, 1.5));
    const double at = between(-0.5, 0.5), tilt = between(-1, 1), m = std::pow(10, between(-6, 6));
    const HeightField ridge =
        height("h*exp(-((X - a + t*Y)/w)^2)", {{"h", high * m}, {"a", at * m}, {"t", tilt}, {"w", width * m}});
    for (int i = 0; i < 100; ++i) {
      const double y = between(-0.2, 0.2);
      Vector3d X = m * Vector3d(at - tilt * y + width * between(-1.5, 1.5), y, 0);
      X[2] = -ridge.level({X[0], X[1], 0}) + high * m * 1e-16 * std::floor(between(-3, 4));
      EXPECT_NEAR(ridge.nearest(X).distance, 0, 1e-13 * m) << X.transpose();
    }
  }
}

/// Two feet close to each other, with a ridge between them.
TEST(AHeightField, KnowsTheDistanceJustBeyondACentreOfCurvature) {
  const Vector3d X(-0.86393802365193673, -0.20919910848202378, -0.093718156500470551);
  EXPECT_NEAR(height("0.1*cos(40*X)*cos(30*Y)").nearest(X).distance, 0.00627585, 1e-7);
}

TEST(AHeightField, IsTheSameInMicrometresAndInMegametres) {
  for (const double m : {1e-6, 1e6}) {
    const HeightField one = height("0.05*cos(4*X)"), other = height("m*0.05*cos(4*X/m)", {{"m", m}});
    for (const Vector3d& X : test::random_points(100, 0.5)) {
      EXPECT_NEAR(other.nearest(m * X).distance / m, one.nearest(X).distance, 1e-12);
      EXPECT_LT((other.nearest(m * X).normal - one.nearest(X).normal).norm(), 1e-10);
    }
  }
}

Raster wave_raster(int n) {
  Eigen::MatrixXd h(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) h(i, j) = 0.05 * std::cos(4.0 * i / (n - 1) - 2) * std::cos(4.0 * j / (n - 1) - 2);
  return {h, {-0.5, -0.5}, 1.0 / (n - 1)};
}

TEST(ARaster, ApproachesTheExpressionItWasMadeFrom) {
  const HeightField exact = height("0.05*cos(4*X)*cos(4*Y)");
  double last = 1;
  for (const int n : {11, 41}) {
    const HeightField raster(std::make_shared<const Raster>(wave_raster(n)));
    double off = 0;
    for (const Vector3d& X : test::random_points(100, 0.2))
      off = std::max(off, std::abs(raster.nearest(X).distance - exact.nearest(X).distance));
    EXPECT_LT(off, last / 50);
    last = off;
  }
  EXPECT_LT(last, 1e-6);
}

TEST(ARaster, HasExactDerivatives) {
  test::expect_exact_derivatives(HeightField(std::make_shared<const Raster>(wave_raster(11))),
                                 test::random_points(100, 0.15), 1, 3);
}

// Points from a random search, 2e-5 off the graph. There the rounding of heights hides the decrease of the squared distance.
TEST(ARaster, KnowsTheDistanceOfPointsCloseToIt) {
  Eigen::MatrixXd h(401, 401);
  for (int i = 0; i < 401; ++i)
    for (int j = 0; j < 401; ++j) h(i, j) = 0.1 * std::cos(0.06 * (i - 200)) * std::cos(0.06 * (j - 200));
  const HeightField field(std::make_shared<const Raster>(h, Eigen::Vector2d(-2, -2), 0.01));
  const Vector3d first(-0.27086811295634622, -0.035068643330694801, -0.0053433813265125751),
      second(0.97453879960632162, 0.0054416807977087107, 0.090573547411082256),
      third(1.0635559555741823, 0.76951810699658729, -0.0094480753413151985);
  EXPECT_NEAR(field.nearest(first).distance, -2.13788e-05, 1e-10);
  EXPECT_NEAR(field.nearest(second).distance, -2.41909e-05, 1e-10);
  EXPECT_NEAR(field.nearest(third).distance, 1.69859e-05, 1e-10);
}

TEST(ARaster, SaysWhereItDoesNotReach) {
  const HeightField raster(std::make_shared<const Raster>(wave_raster(5)));
  EXPECT_THROW(raster.nearest({0.6, 0, 0}), ObstacleError);
  EXPECT_TRUE(std::isnan(raster.level({0.6, 0, 0})));
}

TEST(ARefusedHeight, NamesTheObstacleThePointAndTheReason) {
  const auto said = [](const HeightField& shape, const Vector3d& X) -> std::string {
    try {
      (Obstacle{.name = "floor", .shape = shape}).nearest(X);
    } catch (const ObstacleError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(
      said(HeightField(std::make_shared<const Raster>(wave_raster(5))), {0.6, 0, 1}),
      "the obstacle \"floor\" at the point (0.6, 0, 1) of space: the height field has no height there; the raster "
      "covers X from -0.5 to 0.5 and Y from -0.5 to 0.5 in its own coordinates and must reach beyond the shell on "
      "all sides by as much as the two are apart: give a larger raster, or move it");
  EXPECT_EQ(
      said(height("log(X)"), {-1, 0, 1}),
      "the obstacle \"floor\" at the point (-1, 0, 1) of space: the height field \"log(X)\" is not finite there; it "
      "and its first two derivatives must be, wherever the shell is");
  EXPECT_EQ(
      said(height("0.02*cos(3658*pi*X)"), {0.4, 0.5, 0.075}),
      "the obstacle \"floor\" at the point (0.4, 0.5, 0.075) of space: the height field is 0.055 m away and has waves "
      "shorter than 0.0014 m, too many to find the nearest point among; leave out the fine waves, or bring the "
      "shell nearer");
  EXPECT_EQ(said(height("0.02*cos(3658*pi*X)"), {0.4, 0.5, 0.021}), "");
  // The foot is beyond the edge.
  Eigen::MatrixXd slope(5, 5);
  for (int i = 0; i < 5; ++i) slope.row(i).setConstant(0.25 * i);
  const HeightField hill(std::make_shared<const Raster>(slope, Eigen::Vector2d(0, 0), 0.25));
  EXPECT_EQ(said(hill, {0.4, 0.5, 0.5}), "");
  EXPECT_NE(said(hill, {0.9, 0.5, 1.9}).find("no nearest point there, or one at its edge"), std::string::npos);
}

TEST(ARasterFile, IsReadFromTheNorthAndRefusedInWords) {
  const auto path = (std::filesystem::temp_directory_path() / "plastron_obstacle_test.asc").string();
  const auto write = [&](const std::string& text) { std::ofstream(path) << text; };
  const auto refusal = [&](const std::string& text) -> std::string {
    write(text);
    try {
      read_raster(path);
    } catch (const ObstacleError& error) {
      return error.what();
    }
    return "";
  };
  const std::string head = "ncols 3\nnrows 2\nxllcenter 1\nyllcenter 2\ncellsize 0.5\nNODATA_value -9\n";
  write(head + "1 2 3\n4 5 6\n");
  const Raster raster = read_raster(path);
  EXPECT_NEAR(raster({1, 2}).value, 4, 1e-14);
  EXPECT_NEAR(raster({2, 2.5}).value, 3, 1e-14);
  EXPECT_NE(refusal(head + "1 2 3\n4 5\n").find("ends where a height"), std::string::npos);
  EXPECT_NE(refusal(head + "1 2 3\n4 nan 6\n").find("finite"), std::string::npos);
  EXPECT_NE(refusal(head + "1 2 3\n4 -9 6\n").find("NODATA"), std::string::npos);
  EXPECT_NE(refusal(head + "1 2 3\n4 5 6 7\n").find("more than 3 x 2"), std::string::npos);
  EXPECT_NE(refusal("ncols 3\nnrows 1e9\ncellsize 1\n").find("whole number from 2"), std::string::npos);
  EXPECT_NE(refusal("1 2 3").find("no ncols"), std::string::npos);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace plastron::obstacle

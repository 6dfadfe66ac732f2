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

TEST(ARaster, SaysWhereItDoesNotReach) {
  const HeightField raster(std::make_shared<const Raster>(wave_raster(5)));
  EXPECT_THROW(raster.nearest({0.6, 0, 0}), ObstacleError);
  EXPECT_TRUE(std::isnan(raster.level({0.6, 0, 0})));
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

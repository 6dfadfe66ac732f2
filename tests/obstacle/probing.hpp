// Properties of the distance of every obstacle, whatever its shape.
#pragma once
#include <gtest/gtest.h>
#include <plastron/obstacle/obstacle.hpp>

#include <random>
#include <string>
#include <vector>

namespace plastron::obstacle::test {

inline std::vector<Vector3d> random_points(int count, double reach) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  return points;
}

/// |grad d| = 1, and both derivatives agree with central differences of d, at all points except a few next to a kink.
inline void expect_exact_derivatives(const Shape& shape, const std::vector<Vector3d>& points, double size,
                                     std::size_t most_kinks) {
  const Obstacle body{.shape = shape};
  const double step = 1e-5 * size;
  std::size_t kinks = 0;
  for (const Vector3d& X : points) {
    const Nearest at = body.nearest(X);
    EXPECT_NEAR(at.normal.norm(), 1, 1e-12);
    double off = 0;
    for (int i = 0; i < 3; ++i) {
      const Nearest ahead = body.nearest(X + step * Vector3d::Unit(i)),
                    behind = body.nearest(X - step * Vector3d::Unit(i));
      off = std::max(off, std::abs((ahead.distance - behind.distance) / (2 * step) - at.normal[i]));
      const Vector3d bend = (ahead.normal - behind.normal) / (2 * step);
      off = std::max(off, (bend - at.curvature.col(i)).norm() * size / (1 + std::pow(at.curvature.norm() * size, 3)));
    }
    if (!(off < 1e-6)) ++kinks;
  }
  EXPECT_LE(kinks, most_kinks);
}

/// No point of the surface is nearer than d, and one is as near: X - d n.
inline void expect_true_distance(const Shape& shape, const std::vector<Vector3d>& points, double size) {
  const Obstacle body{.shape = shape};
  for (const Vector3d& X : points) {
    const Nearest at = body.nearest(X);
    EXPECT_NEAR(body.nearest(X - at.distance * at.normal).distance, 0, 1e-9 * size);
    for (const Vector3d& direction : random_points(20, 1)) {
      const Vector3d nearer = X + 0.99 * std::abs(at.distance) * direction.normalized();
      EXPECT_GE(body.nearest(nearer).distance * (at.distance < 0 ? -1 : 1), -1e-9 * size);
    }
  }
}

}  // namespace plastron::obstacle::test

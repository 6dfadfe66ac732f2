// The point of a triangle nearest to X.
#pragma once
#include <plastron/geometry/jet.hpp>

#include <array>

namespace plastron::obstacle {

/// The foot and its feature: 0 to 2 a corner, 3 to 5 the sides 01, 12, 20, 6 the inside.
struct TriangleFoot {
  geometry::Vector3d at;
  int place;
};

inline TriangleFoot foot_on_side(const geometry::Vector3d& X, const geometry::Vector3d& p, const geometry::Vector3d& q,
                                 int side) {
  const geometry::Vector3d along = q - p;
  const double s = (X - p).dot(along) / along.squaredNorm();
  if (s <= 0) return {p, side};
  if (s >= 1) return {q, (side + 1) % 3};
  return {p + s * along, 3 + side};
}

/// Returns the projection of X if it is in the triangle, else the nearest foot on the sides that X projects beyond.
inline TriangleFoot foot_on_triangle(const geometry::Vector3d& X, const std::array<geometry::Vector3d, 3>& p,
                                     const geometry::Vector3d& normal) {
  TriangleFoot best{geometry::Vector3d::Zero(), 6};
  double least = -1;
  for (int k = 0; k < 3; ++k) {
    const geometry::Vector3d &from = p[k], &to = p[(k + 1) % 3];
    if (normal.cross(to - from).dot(X - from) > 0) continue;
    const TriangleFoot foot = foot_on_side(X, from, to, k);
    const double d = (X - foot.at).squaredNorm();
    if (least < 0 || d < least) least = d, best = foot;
  }
  if (best.place == 6) best.at = X - (X - p[0]).dot(normal) * normal;
  return best;
}

}  // namespace plastron::obstacle

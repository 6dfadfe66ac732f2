// The point of a triangle nearest to X; and the normals of a closed surface of triangles at faces, sides and corners.
// The nearest of these gives the signed distance.
#pragma once
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/triangle_mesh.hpp>

#include <vector>

namespace plastron::obstacle {

/// The foot and its feature: 0 to 2 a corner, 3 to 5 the sides 01, 12, 20, 6 the inside.
struct TriangleFoot {
  Vector3d at;
  int place;
};

inline TriangleFoot foot_on_side(const Vector3d& X, const Vector3d& p, const Vector3d& q, int side) {
  const Vector3d along = q - p;
  const double s = (X - p).dot(along) / along.squaredNorm();
  if (s <= 0) return {p, side};
  if (s >= 1) return {q, (side + 1) % 3};
  return {p + s * along, 3 + side};
}

/// Returns the projection of X if it is in the triangle, else the nearest foot on the sides that X projects beyond.
inline TriangleFoot foot_on_triangle(const Vector3d& X, const std::array<Vector3d, 3>& p, const Vector3d& normal) {
  TriangleFoot best{Vector3d::Zero(), 6};
  double least = -1;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &from = p[k], &to = p[(k + 1) % 3];
    if (normal.cross(to - from).dot(X - from) > 0) continue;
    const TriangleFoot foot = foot_on_side(X, from, to, k);
    const double d = (X - foot.at).squaredNorm();
    if (least < 0 || d < least) least = d, best = foot;
  }
  if (best.place == 6) best.at = X - (X - p[0]).dot(normal) * normal;
  return best;
}

class TriangleFeatures {
 public:
  /// Precondition: the mesh passes check_closed.
  explicit TriangleFeatures(const TriangleMesh& mesh);

  /// Returns the values at X. `triangle` contains the surface's nearest point to X.
  Nearest nearest(const TriangleMesh& mesh, int triangle, const Vector3d& X) const;

  /// The unit normals of the triangles.
  const std::vector<Vector3d>& faces() const { return faces_; }

 private:
  /// Unit mean of the normals; flat if all of them are equal.
  struct Feature {
    Vector3d normal;
    bool flat;
  };
  std::vector<Vector3d> faces_;
  std::vector<std::array<Feature, 3>> sides_;  // sides of each triangle: 01, 12, 20
  std::vector<Feature> corners_;
};

}  // namespace plastron::obstacle

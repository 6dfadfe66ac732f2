// The normals of a closed surface of triangles at faces, sides and corners, and the signed distance from the nearest of them.
#pragma once
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/triangle_mesh.hpp>

#include <vector>

namespace plastron::obstacle {

class TriangleFeatures {
 public:
  /// Precondition: check_closed.
  explicit TriangleFeatures(const TriangleMesh& mesh);

  /// From the point of `triangle` that is nearest to X, which is the nearest of the surface.
  Nearest nearest(const TriangleMesh& mesh, int triangle, const Vector3d& X) const;

  /// The unit normals of the triangles.
  const std::vector<Vector3d>& faces() const { return faces_; }

 private:
  /// Unit mean of the normals; flat where all of them are equal.
  struct Feature {
    Vector3d normal;
    bool flat;
  };
  std::vector<Vector3d> faces_;
  std::vector<std::array<Feature, 3>> sides_;  // of each triangle: 01, 12, 20
  std::vector<Feature> corners_;
};

}  // namespace plastron::obstacle

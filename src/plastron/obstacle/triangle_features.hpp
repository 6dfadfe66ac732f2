// The normals of a closed surface of triangles at faces, sides and corners. The nearest of these gives the signed
// distance.
#pragma once
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/triangle_mesh.hpp>

#include <vector>

namespace plastron::obstacle {

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

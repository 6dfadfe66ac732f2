// A body bounded by triangles, as drawing programs write it. Its nearest point is found in a tree of turned boxes; CGAL
// sees to crossings.
#pragma once
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/triangle_mesh.hpp>

#include <memory>
#include <string>

namespace plastron::obstacle {

class TriangleSurface {
 public:
  /// Throws ObstacleError, `name` in front, unless the mesh passes check_closed and no two of its triangles cross or touch but at corners
  /// and
  /// sides they share.
  explicit TriangleSurface(TriangleMesh mesh, const std::string& name = "the surface");

  /// The gradient of the distance to the nearest point of the triangles: the face's normal if that is inside a face; from a side or a
  /// corner
  /// the direction to X; on those the mean of the normals, weighted by angles (Baerentzen and Aanaes 2005), which also gives
  /// the sign. The curvature is that of the surface of equal distance: 0 over faces, 1/d around sides and corners.
  Nearest nearest(const Vector3d& X) const;

  const TriangleMesh& mesh() const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace plastron::obstacle

// A body bounded by triangles, as written by drawing programs. A tree of oriented boxes finds its nearest point; CGAL
// checks crossings.
#pragma once
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/triangle_mesh.hpp>

#include <memory>
#include <string>

namespace plastron::obstacle {

class TriangleSurface {
 public:
  /// Throws ObstacleError with `name` in front unless the mesh passes check_closed and no two of its triangles cross.
  /// They may touch only at common corners and sides.
  explicit TriangleSurface(TriangleMesh mesh, const std::string& name = "the surface");

  /// Returns the distance with its derivatives. If the nearest point is inside a face, the gradient is the face's
  /// normal. If it is on a side or a corner, the gradient is the direction to X. If X itself is on a side or a
  /// corner, the gradient is the mean of the normals, weighted by angles (Baerentzen and Aanaes 2005). This mean also
  /// gives the sign. The curvature belongs to the surface of equal distance: 0 over faces, 1/d around sides and
  /// corners.
  Nearest nearest(const Vector3d& X) const;

  std::optional<Extent> extent() const;

  const TriangleMesh& mesh() const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace plastron::obstacle

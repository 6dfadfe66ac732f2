// Cells as flat triangles between neighbouring nodes of their lattices, for distances and intersections. The triangles
// of a curved cell are off its surface by the sagitta of the arc between two nodes.
#pragma once
#include <plastron/topology/box_tree.hpp>
#include <plastron/topology/space_mesh.hpp>

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace plastron::topology {

/// The point of a triangle nearest to a point.
Vector3d nearest_point(const std::array<Vector3d, 3>& triangle, const Vector3d& point);
/// The parameter, 0 at `from` and 1 at `to`, where a segment passes through a triangle.
std::optional<double> passage(const std::array<Vector3d, 3>& triangle, const Vector3d& from, const Vector3d& to);

class CellFacets {
 public:
  explicit CellFacets(const SpaceMesh& mesh);

  Vector3d nearest(std::size_t cell, const Vector3d& point) const;
  /// Where a segment passes through the cell between its ends.
  std::optional<Vector3d> crossing(std::size_t cell, const Vector3d& from, const Vector3d& to) const;
  /// Unit normal of the plane that fits the corners.
  const Vector3d& normal(std::size_t cell) const { return normals_[cell]; }
  Vector3d centre(std::size_t cell) const;
  /// Length of the longest side's chord [m].
  double size(std::size_t cell) const { return sizes_[cell]; }
  const BoxTree& tree() const { return tree_; }

 private:
  using Triangles = std::vector<std::array<int, 3>>;
  std::array<Vector3d, 3> triangle(std::size_t cell, const std::array<int, 3>& places) const;

  const SpaceMesh& mesh_;
  std::map<int, Triangles> triangles_;  ///< by order: positions on the lattice
  std::vector<Vector3d> normals_;
  std::vector<double> sizes_;
  BoxTree tree_;
};

}  // namespace plastron::topology

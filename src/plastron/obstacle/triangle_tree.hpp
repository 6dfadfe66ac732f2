// A tree of boxes around triangles, which finds the triangle nearest to a point.
#pragma once
#include <plastron/obstacle/triangle_mesh.hpp>

#include <vector>

namespace plastron::obstacle {

/// Halves are taken at the middle triangle along the longest side of the box of their middles. A query goes into the nearer box first, so
/// that the other
/// is mostly out of reach by then.
class TriangleTree {
 public:
  /// Precondition: at least one triangle.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// The triangle of the mesh whose nearest point is nearest to X; among equals the one met first.
  int nearest(const geometry::Vector3d& X) const;

 private:
  struct Box {
    geometry::Vector3d low, high;
    double squared_distance(const geometry::Vector3d& X) const {
      return (low - X).cwiseMax(X - high).cwiseMax(0).squaredNorm();
    }
  };
  struct Node {
    Box box;
    int first, count;  // of triangles in a leaf; count 0: children at first and first + 1
  };
  struct Corners {
    geometry::Vector3d a, b, c;
    int triangle;
  };
  struct Search;

  void divide(int node, int first, int last);
  void search(int node, Search& search) const;

  std::vector<Node> nodes_;
  std::vector<Corners> leaves_;
};

}  // namespace plastron::obstacle

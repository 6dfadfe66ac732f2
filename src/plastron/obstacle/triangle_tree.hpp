// The nearest triangle, found in a tree of boxes, each oriented along its triangles. On a curved surface such a box
// is thin. A box along the axes is as deep as it is wide and therefore nearer to X than its triangles
// (docs/performance.md, "Obstacles").
#pragma once
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/triangle_mesh.hpp>

#include <vector>

namespace plastron::obstacle {

class TriangleTree {
 public:
  /// Builds the tree. `normals` are the triangles' unit normals. Keeps no reference.
  TriangleTree(const TriangleMesh& mesh, const std::vector<Vector3d>& normals);

  /// Returns the nearest triangle; mesh and normals are the constructor's arguments. Among triangles at equal
  /// distance the choice does not depend on earlier calls.
  int nearest(const TriangleMesh& mesh, const std::vector<Vector3d>& normals, const Vector3d& X) const;

 private:
  /// The box |axes X - middle| <= half around order_[begin] to order_[end - 1]. Its first child follows it.
  struct Box {
    Matrix3d axes;  // axes in rows
    Vector3d middle, half;
    int begin, end, second_child;

    double squared_distance(const Vector3d& X) const {
      return ((axes * X - middle).cwiseAbs() - half).cwiseMax(0).squaredNorm();
    }
  };

  Box box_around(const TriangleMesh& mesh, const std::vector<Vector3d>& normals, int begin, int end) const;
  void divide(const TriangleMesh& mesh, const std::vector<Vector3d>& normals, int begin, int end);

  std::vector<int> order_;
  std::vector<Box> boxes_;
};

}  // namespace plastron::obstacle

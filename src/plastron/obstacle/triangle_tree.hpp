// Which triangle is nearest: a tree of boxes, each turned along the triangles it holds. On a curved surface such a box
// is thin, where one along the axes is as deep as it is wide and nearer to X than what it holds (docs/performance.md,
// "Obstacles").
#pragma once
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/triangle_mesh.hpp>

#include <vector>

namespace plastron::obstacle {

class TriangleTree {
 public:
  /// `normals` are the triangles' unit normals. Keeps no reference.
  TriangleTree(const TriangleMesh& mesh, const std::vector<Vector3d>& normals);

  /// With the mesh and the normals it was made from. Of triangles at one distance always the same, whatever was asked
  /// before.
  int nearest(const TriangleMesh& mesh, const std::vector<Vector3d>& normals, const Vector3d& X) const;

 private:
  /// The box |axes X - middle| <= half around order_[begin] to order_[end - 1]. Its first child follows it.
  struct Box {
    Matrix3d axes;  // in rows
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

#include <plastron/facets/triangles.hpp>

#include <Eigen/Geometry>

namespace plastron::facets {

Vector3d normal_of(const TriangleMesh& mesh, const std::array<int, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
}

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& triangle : mesh.triangles) area += normal_of(mesh, triangle).norm() / 2;
  return area;
}

}  // namespace plastron::facets

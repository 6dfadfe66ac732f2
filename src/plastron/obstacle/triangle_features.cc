#include <plastron/obstacle/triangle_features.hpp>

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace plastron::obstacle {

namespace {

constexpr double equal_normals = 1e-9;

std::uint64_t directed(int from, int to) {
  return (static_cast<std::uint64_t>(from) << 32) | static_cast<std::uint32_t>(to);
}

}  // namespace

TriangleFeatures::TriangleFeatures(const TriangleMesh& mesh)
    : faces_(mesh.triangles.size()),
      sides_(mesh.triangles.size()),
      corners_(mesh.points.size(), {Vector3d::Zero(), true}) {
  std::unordered_map<std::uint64_t, int> on_left;
  on_left.reserve(3 * mesh.triangles.size());
  std::vector<Vector3d> first(mesh.points.size(), Vector3d::Zero());
  for (std::size_t t = 0; t < faces_.size(); ++t) {
    const auto& corner = mesh.triangles[t];
    const Vector3d &a = mesh.points[corner[0]], &b = mesh.points[corner[1]], &c = mesh.points[corner[2]];
    faces_[t] = (b - a).cross(c - a).normalized();
    for (int k = 0; k < 3; ++k) {
      on_left[directed(corner[k], corner[(k + 1) % 3])] = static_cast<int>(t);
      const Vector3d& at = mesh.points[corner[k]];
      const Vector3d u = mesh.points[corner[(k + 1) % 3]] - at, v = mesh.points[corner[(k + 2) % 3]] - at;
      Feature& feature = corners_[corner[k]];
      if (first[corner[k]].isZero(0)) first[corner[k]] = faces_[t];
      feature.flat = feature.flat && (faces_[t] - first[corner[k]]).norm() < equal_normals;
      feature.normal += std::atan2(u.cross(v).norm(), u.dot(v)) * faces_[t];
    }
  }
  for (Feature& corner : corners_) corner.normal.normalize();
  for (std::size_t t = 0; t < faces_.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto& corner = mesh.triangles[t];
      const Vector3d& other = faces_[on_left.at(directed(corner[(k + 1) % 3], corner[k]))];
      sides_[t][k] = {(faces_[t] + other).normalized(), (faces_[t] - other).norm() < equal_normals};
    }
}

Nearest TriangleFeatures::nearest(const TriangleMesh& mesh, int triangle, const Vector3d& X) const {
  const auto& corner = mesh.triangles[triangle];
  const std::array<Vector3d, 3> p{mesh.points[corner[0]], mesh.points[corner[1]], mesh.points[corner[2]]};
  const Vector3d& face = faces_[triangle];
  const TriangleFoot foot = foot_on_triangle(X, p, face);
  Nearest over_face{(X - p[0]).dot(face), face, Matrix3d::Zero()};
  if (foot.place == 6) return over_face;
  const bool is_side = foot.place >= 3;
  const Feature& feature = is_side ? sides_[triangle][foot.place - 3] : corners_[corner[foot.place]];
  if (feature.flat) return over_face;
  const Vector3d way = X - foot.at;
  const double length = way.norm(), size = (p[1] - p[0]).cwiseAbs().maxCoeff() + foot.at.cwiseAbs().maxCoeff();
  constexpr double rounding = 1e-14;
  if (length <= rounding * size) return {way.dot(feature.normal), feature.normal, Matrix3d::Zero()};
  const double sign = way.dot(feature.normal) < 0 ? -1 : 1;
  const Vector3d n = sign / length * way;
  Matrix3d across = Matrix3d::Identity() - n * n.transpose();
  if (is_side) {
    const int k = foot.place - 3;
    const Vector3d along = (p[(k + 1) % 3] - p[k]).normalized();
    across -= along * along.transpose();
  }
  return {sign * length, n, sign / length * across};
}

}  // namespace plastron::obstacle

#include <plastron/obstacle/triangle_features.hpp>
#include <plastron/obstacle/triangle_tree.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace plastron::obstacle {

namespace {

constexpr int most_in_leaf = 4;

std::array<Vector3d, 3> corners_of(const TriangleMesh& mesh, int triangle) {
  const auto& c = mesh.triangles[triangle];
  return {mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]};
}

Vector3d three_centroids(const TriangleMesh& mesh, int triangle) {
  const auto [a, b, c] = corners_of(mesh, triangle);
  return a + b + c;
}

/// Axes in rows: the longest direction of the triangles first, the mean normal last. If the normals point in all
/// directions, the axes of space.
Matrix3d axes_along(const Vector3d& normal, double area, const Vector3d& extent) {
  constexpr double looks_everywhere = 0.3;
  if (normal.norm() < looks_everywhere * area) return Matrix3d::Identity();
  const Vector3d n = normal.normalized();
  int longest = 0;
  (extent.array() * (1 - n.array().square())).maxCoeff(&longest);
  const Vector3d t = (Vector3d::Unit(longest) - n[longest] * n).normalized();
  Matrix3d axes;
  axes << t.transpose(), n.cross(t).transpose(), n.transpose();
  return axes;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh, const std::vector<Vector3d>& normals)
    : order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  boxes_.reserve(order_.size());
  divide(mesh, normals, 0, static_cast<int>(order_.size()));
}

TriangleTree::Box TriangleTree::box_around(const TriangleMesh& mesh, const std::vector<Vector3d>& normals, int begin,
                                           int end) const {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vector3d normal = Vector3d::Zero(), low = Vector3d::Constant(inf), high = -low;
  double area = 0;
  for (int i = begin; i < end; ++i) {
    const auto p = corners_of(mesh, order_[i]);
    const double twice = (p[1] - p[0]).cross(p[2] - p[0]).norm();
    area += twice, normal += twice * normals[order_[i]];
    for (const Vector3d& corner : p) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
  }
  Box box{axes_along(normal, area, high - low), {}, {}, begin, end, 0};
  low.setConstant(inf), high = -low;
  for (int i = begin; i < end; ++i)
    for (const Vector3d& corner : corners_of(mesh, order_[i])) {
      const Vector3d at = box.axes * corner;
      low = low.cwiseMin(at), high = high.cwiseMax(at);
    }
  box.middle = (low + high) / 2;
  box.half = (high - low) / 2;
  return box;
}

/// Divides into two halves along the longest extent of the centroids.
void TriangleTree::divide(const TriangleMesh& mesh, const std::vector<Vector3d>& normals, int begin, int end) {
  const std::size_t here = boxes_.size();
  boxes_.push_back(box_around(mesh, normals, begin, end));
  if (end - begin <= most_in_leaf) return;
  Vector3d low = three_centroids(mesh, order_[begin]), high = low;
  for (int i = begin; i < end; ++i) {
    const Vector3d at = three_centroids(mesh, order_[i]);
    low = low.cwiseMin(at), high = high.cwiseMax(at);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  const auto place = [&](int t) { return std::pair(three_centroids(mesh, t)[axis], t); };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int s, int t) { return place(s) < place(t); });
  divide(mesh, normals, begin, middle);
  boxes_[here].second_child = static_cast<int>(boxes_.size());
  divide(mesh, normals, middle, end);
}

int TriangleTree::nearest(const TriangleMesh& mesh, const std::vector<Vector3d>& normals, const Vector3d& X) const {
  int found = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](int triangle) {
    const auto p = corners_of(mesh, triangle);
    const double above = (X - p[0]).dot(normals[triangle]);
    if (above * above >= least) return;
    const double d = (X - foot_on_triangle(X, p, normals[triangle]).at).squaredNorm();
    if (d < least) least = d, found = triangle;
  };
  // Repeated halving of an int: less than 32 levels.
  std::array<std::pair<int, double>, 64> waiting;
  std::size_t count = 0;
  waiting[count++] = {0, boxes_[0].squared_distance(X)};
  while (count > 0) {
    const auto [at, bound] = waiting[--count];
    if (bound >= least) continue;
    const Box& box = boxes_[at];
    if (box.second_child == 0) {
      for (int i = box.begin; i < box.end; ++i) look_at(order_[i]);
      continue;
    }
    std::pair<int, double> near{at + 1, boxes_[at + 1].squared_distance(X)},
        far{box.second_child, boxes_[box.second_child].squared_distance(X)};
    if (far.second < near.second) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
  return found;
}

}  // namespace plastron::obstacle

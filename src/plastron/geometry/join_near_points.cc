// Joins corners that were separated by rounding when a surface was written: only at open sides, and only within
// rounding.
#include <plastron/geometry/triangle_mesh.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace plastron::geometry {

namespace {

/// The corners of sides with only one triangle, ascending.
std::vector<int> open_corners(const TriangleMesh& mesh) {
  const auto sides = sorted_sides(mesh);
  std::set<int> corners;
  for (std::size_t i = 0; i < sides.size(); ++i)
    if ((i == 0 || !sides[i].is_same(sides[i - 1])) && (i + 1 == sides.size() || !sides[i].is_same(sides[i + 1])))
      corners.insert({sides[i].low, sides[i].high});
  return {corners.begin(), corners.end()};
}

/// Median length of the sides [m].
double median_side(const TriangleMesh& mesh) {
  std::vector<double> lengths;
  lengths.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(triangle[k]), b = static_cast<std::size_t>(triangle[(k + 1) % 3]);
      lengths.push_back((mesh.points[a] - mesh.points[b]).norm());
    }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, middle);
  return *middle;
}

/// Points in cubes much wider than the tolerance: points near a given one are in its own cube or, rarely, in a
/// neighbouring one.
class Cubes {
 public:
  Cubes(const std::vector<Vector3d>& points, double tolerance) : points_(points), tolerance_(tolerance) {}

  /// Returns the first added point within the tolerance; adds `point` if there is none.
  int first_near(int point) {
    const Vector3d& X = points_[point];
    std::set<Key> near;
    for (const double x : {-tolerance_, tolerance_})
      for (const double y : {-tolerance_, tolerance_})
        for (const double z : {-tolerance_, tolerance_}) near.insert(key(X + Vector3d(x, y, z)));
    int first = point;
    for (const Key& cube : near)
      if (const auto found = cubes_.find(cube); found != cubes_.end())
        for (const int other : found->second)
          if ((points_[other] - X).norm() <= tolerance_) first = std::min(first, other);
    if (first == point) cubes_[key(X)].push_back(point);
    return first;
  }

 private:
  using Key = std::array<std::int64_t, 3>;

  Key key(const Vector3d& X) const {
    constexpr double width = 1000;  // in multiples of the tolerance
    const auto at = [&](double x) { return static_cast<std::int64_t>(std::floor(x / (width * tolerance_))); };
    return {at(X[0]), at(X[1]), at(X[2])};
  }

  const std::vector<Vector3d>& points_;
  double tolerance_;
  std::map<Key, std::vector<int>> cubes_;
};

/// Removes triangles with two equal corners.
void remove_triangles_without_sides(TriangleMesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    if (a == b || b == c || c == a) continue;
    mesh.triangles[kept] = {a, b, c};
    if (!mesh.group_of.empty()) mesh.group_of[kept] = mesh.group_of[t];
    ++kept;
  }
  mesh.triangles.resize(kept);
  if (!mesh.group_of.empty()) mesh.group_of.resize(kept);
}

/// Removes points that no triangle uses.
void remove_unused_points(TriangleMesh& mesh) {
  std::vector<int> number(mesh.points.size(), -1);
  std::vector<Vector3d> used;
  for (auto& triangle : mesh.triangles)
    for (int& corner : triangle) {
      int& now = number[corner];
      if (now < 0) now = static_cast<int>(used.size()), used.push_back(mesh.points[corner]);
      corner = now;
    }
  mesh.points = std::move(used);
}

}  // namespace

std::vector<TriangleSide> sorted_sides(const TriangleMesh& mesh) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  std::ranges::sort(sides, [](const TriangleSide& p, const TriangleSide& q) {
    return std::tie(p.low, p.high, p.triangle) < std::tie(q.low, q.high, q.triangle);
  });
  return sides;
}

double joining_distance(const TriangleMesh& mesh) {
  constexpr double part_of_side = 1e-2;
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.points) box.extend(p);
  return std::min(joining_tolerance * box.diagonal().norm(), part_of_side * median_side(mesh));
}

void join_near_points(TriangleMesh& mesh) { join_near_points(mesh, joining_distance(mesh)); }

void join_near_points(TriangleMesh& mesh, double tolerance) {
  const std::vector<int> open = open_corners(mesh);
  if (open.empty()) return;
  double largest = 0;
  for (const Vector3d& p : mesh.points) largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  // Equal points were already joined.
  if (!(tolerance > std::numeric_limits<double>::epsilon() * largest)) return;
  Cubes cubes(mesh.points, tolerance);
  std::map<int, int> joined;
  for (const int point : open) {
    const int first = cubes.first_near(point);
    if (first == point) continue;
    joined[point] = first;
    const Vector3d way = mesh.points[point] - mesh.points[first];
    mesh.joined_over = std::max(mesh.joined_over, way.norm());
  }
  if (joined.empty()) return;
  mesh.joined += joined.size();
  for (auto& triangle : mesh.triangles)
    for (int& corner : triangle)
      if (const auto found = joined.find(corner); found != joined.end()) corner = found->second;
  remove_triangles_without_sides(mesh);
  remove_unused_points(mesh);
}

}  // namespace plastron::geometry

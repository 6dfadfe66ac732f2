#include <plastron/facets/cells.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace plastron::facets {

namespace {

using Polygon = std::vector<int>;
using Ends = std::array<int, 2>;

Ends ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Two triangles on a side and the quadrilateral that they make.
struct Pair {
  double skewness;  ///< largest difference of an angle from a right one [rad]
  std::array<std::size_t, 2> triangles;
  std::array<int, 4> corners;
};

double skewness_of(const std::array<int, 4>& corners, const std::vector<Vector3d>& points) {
  double largest = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector3d& at = points[corners[k]];
    const Vector3d next = points[corners[(k + 1) % 4]] - at, last = points[corners[(k + 3) % 4]] - at;
    const double angle = std::atan2(next.cross(last).norm(), next.dot(last));
    largest = std::max(largest, std::abs(angle - std::numbers::pi / 2));
  }
  return largest;
}

/// Adds the pair of two triangles on the side of the first one from corner k to the next.
void add_pair(const Remeshed& mesh, const std::array<std::size_t, 2>& both, std::size_t k, std::vector<Pair>& pairs) {
  constexpr double most_skew = std::numbers::pi / 3;
  const auto &t = mesh.triangles[both[0]], &o = mesh.triangles[both[1]];
  const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
  int d = o[0];
  for (const int corner : o)
    if (corner != a && corner != b) d = corner;
  const std::array corners{a, d, b, c};
  const auto normal = [&](int p, int q, int r) {
    return Vector3d((mesh.points[q] - mesh.points[p]).cross(mesh.points[r] - mesh.points[p]));
  };
  // Each of the two other triangles of the quadrilateral must be turned alike, too: else it has an angle above 180 degrees.
  const Vector3d mean = normal(a, b, c) + normal(a, d, b);
  if (normal(a, d, c).dot(mean) <= 0 || normal(d, b, c).dot(mean) <= 0) return;
  const double skewness = skewness_of(corners, mesh.points);
  if (skewness < most_skew) pairs.push_back({skewness, both, corners});
}

std::vector<Pair> pairs_of(const Remeshed& mesh, const std::map<Ends, int>& curve_at) {
  std::map<Ends, std::vector<std::pair<std::size_t, std::size_t>>> at_side;  // triangle and corner
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      at_side[ascending(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3])].emplace_back(t, k);
  std::vector<Pair> pairs;
  for (const auto& [ends, both] : at_side)
    if (both.size() == 2 && !curve_at.contains(ends))
      add_pair(mesh, {both[0].first, both[1].first}, both[0].second, pairs);
  std::ranges::sort(pairs, {}, [](const Pair& pair) { return std::tuple(pair.skewness, pair.triangles); });
  return pairs;
}

class CellBuilder {
 public:
  CellBuilder(const Remeshed& mesh, const FacetProjection& projection) : mesh_(mesh), projection_(projection) {
    cells_.points = mesh.points;
    for (const auto& [ends, curve] : mesh.lines) curve_at_[ascending(ends[0], ends[1])] = curve;
  }

  Cells build() {
    std::vector<bool> is_used(mesh_.triangles.size(), false);
    for (const auto& [skewness, both, corners] : pairs_of(mesh_, curve_at_)) {
      if (is_used[both[0]] || is_used[both[1]]) continue;
      is_used[both[0]] = is_used[both[1]] = true;
      divide({corners.begin(), corners.end()}, mesh_.face_of[both[0]]);
    }
    for (std::size_t t = 0; t < is_used.size(); ++t)
      if (!is_used[t]) divide({mesh_.triangles[t].begin(), mesh_.triangles[t].end()}, mesh_.face_of[t]);
    for (const auto& [ends, curve] : mesh_.lines) {
      const int centre = middle(ends[0], ends[1]);
      cells_.lines.push_back({{ends[0], centre}, curve});
      cells_.lines.push_back({{centre, ends[1]}, curve});
    }
    return std::move(cells_);
  }

 private:
  /// Adds a quadrilateral for each corner of a polygon: the corner, the middles of its sides, and the polygon's middle.
  void divide(const Polygon& polygon, int face) {
    Vector3d mean = Vector3d::Zero();
    for (const int corner : polygon) mean += mesh_.points[corner] / static_cast<double>(polygon.size());
    const int centre = add(projection_.on_facets(mean));
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const int last = polygon[(k + polygon.size() - 1) % polygon.size()], next = polygon[(k + 1) % polygon.size()];
      cells_.quadrilaterals.push_back({polygon[k], middle(polygon[k], next), centre, middle(last, polygon[k])});
      cells_.face_of.push_back(face);
    }
  }

  int middle(int a, int b) {
    const Ends ends = ascending(a, b);
    if (const auto known = middle_of_.find(ends); known != middle_of_.end()) return known->second;
    const Vector3d between = (mesh_.points[a] + mesh_.points[b]) / 2;
    const auto curve = curve_at_.find(ends);
    const int point =
        add(curve == curve_at_.end() ? projection_.on_facets(between) : projection_.on_curve(between, curve->second));
    middle_of_.emplace(ends, point);
    return point;
  }

  int add(const Vector3d& point) {
    cells_.points.push_back(point);
    return static_cast<int>(cells_.points.size()) - 1;
  }

  const Remeshed& mesh_;
  const FacetProjection& projection_;
  std::map<Ends, int> curve_at_{}, middle_of_{};
  Cells cells_{};
};

}  // namespace

Cells quadrilaterals(const Facets& facets, double size, const std::string& name) {
  constexpr double side_of_triangles = 2.2;  // of those that become quadrilaterals with sides of about 1
  const FacetProjection projection(facets);
  return CellBuilder(remesh(facets, side_of_triangles * size, name), projection).build();
}

}  // namespace plastron::facets

#include <plastron/facets/cells.hpp>
#include <plastron/facets/triangle_pairs.hpp>
#include <plastron/facets/triangles.hpp>
#include <plastron/facets/untangle.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace plastron::facets {

namespace {

/// A triangle, or a pair of two, that becomes cells.
struct Polygon {
  std::vector<int> corners;
  std::vector<std::size_t> triangles;
  std::size_t first_cell = 0;
  bool is_flat = false;  ///< its new points are not put onto the facets
};

/// Whether the normal of a quadrilateral nearly vanishes at a corner, or turns by a right angle.
bool is_folded(const std::array<int, 4>& corners, const std::vector<Vector3d>& points) {
  constexpr double least_cosine = 0.1;
  std::array<Vector3d, 4> normals;
  Vector3d mean = Vector3d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector3d& at = points[corners[k]];
    normals[k] = (points[corners[(k + 1) % 4]] - at).cross(points[corners[(k + 3) % 4]] - at);
    mean += normals[k];
  }
  return std::ranges::any_of(normals,
                             [&](const Vector3d& n) { return !(n.dot(mean) > least_cosine * n.norm() * mean.norm()); });
}

class CellBuilder {
 public:
  CellBuilder(const Remeshed& mesh, const FacetProjection& projection) : mesh_(mesh), projection_(projection) {
    for (const auto& [ends, curve] : mesh.lines) curve_at_[ascending(ends[0], ends[1])] = curve;
  }

  Cells build() {
    constexpr int most_rounds = 4;
    choose_polygons();
    for (int round = 1; make_cells(), round < most_rounds && flatten_folded();) ++round;
    for (const auto& [ends, curve] : mesh_.lines) {
      const int centre = middle(ends[0], ends[1]);
      cells_.lines.push_back({{ends[0], centre}, curve});
      cells_.lines.push_back({{centre, ends[1]}, curve});
    }
    return std::move(cells_);
  }

 private:
  void choose_polygons() {
    std::vector<bool> is_used(mesh_.triangles.size(), false);
    const auto is_curve = [&](const Ends& ends) { return curve_at_.contains(ends); };
    for (const TrianglePair& pair : triangle_pairs(mesh_.points, mesh_.triangles, is_curve)) {
      is_used[pair.triangles[0]] = is_used[pair.triangles[1]] = true;
      polygons_.push_back({{pair.corners.begin(), pair.corners.end()}, {pair.triangles.begin(), pair.triangles.end()}});
    }
    for (std::size_t t = 0; t < is_used.size(); ++t)
      if (!is_used[t]) polygons_.push_back(triangle(t));
  }

  Polygon triangle(std::size_t t) const { return {{mesh_.triangles[t].begin(), mesh_.triangles[t].end()}, {t}}; }

  void make_cells() {
    cells_ = {.points = mesh_.points};
    middle_of_.clear();
    for (Polygon& polygon : polygons_) divide(polygon);
  }

  /// Points on the facets may fold a cell where facets are finer than cells. Such polygons are divided flat, and pairs that are
  /// flat already are divided as two triangles. Returns whether there are such polygons.
  bool flatten_folded() {
    std::vector<Polygon> halves;
    bool has_folded = false;
    for (Polygon& polygon : polygons_) {
      const auto begin = cells_.quadrilaterals.begin() + static_cast<std::ptrdiff_t>(polygon.first_cell);
      if (std::none_of(begin, begin + static_cast<std::ptrdiff_t>(polygon.corners.size()),
                       [&](const auto& corners) { return is_folded(corners, cells_.points); }))
        continue;
      has_folded = true;
      if (polygon.is_flat && polygon.triangles.size() == 2) {
        halves.push_back(triangle(polygon.triangles[1]));
        polygon = triangle(polygon.triangles[0]);
      }
      polygon.is_flat = true;
      for (std::size_t k = 0; k < polygon.corners.size(); ++k)
        flat_sides_.insert(ascending(polygon.corners[k], polygon.corners[(k + 1) % polygon.corners.size()]));
    }
    for (Polygon& half : halves) {
      half.is_flat = true;
      polygons_.push_back(std::move(half));
    }
    return has_folded;
  }

  /// Adds a quadrilateral for each corner of a polygon: the corner, the middles of its sides, and the polygon's middle.
  void divide(Polygon& polygon) {
    const std::vector<int>& corners = polygon.corners;
    polygon.first_cell = cells_.quadrilaterals.size();
    Vector3d mean = Vector3d::Zero();
    for (const int corner : corners) mean += mesh_.points[corner] / static_cast<double>(corners.size());
    const int centre = add(polygon.is_flat ? mean : projection_.on_facets(mean));
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int last = corners[(k + corners.size() - 1) % corners.size()], next = corners[(k + 1) % corners.size()];
      cells_.quadrilaterals.push_back({corners[k], middle(corners[k], next), centre, middle(last, corners[k])});
      cells_.face_of.push_back(mesh_.face_of[polygon.triangles.front()]);
    }
  }

  int middle(int a, int b) {
    const Ends ends = ascending(a, b);
    if (const auto known = middle_of_.find(ends); known != middle_of_.end()) return known->second;
    const Vector3d between = (mesh_.points[a] + mesh_.points[b]) / 2;
    const auto curve = curve_at_.find(ends);
    const int point = add(flat_sides_.contains(ends) ? between
                          : curve == curve_at_.end() ? projection_.on_facets(between)
                                                     : projection_.on_curve(between, curve->second));
    middle_of_.emplace(ends, point);
    return point;
  }

  int add(const Vector3d& point) {
    cells_.points.push_back(point);
    return static_cast<int>(cells_.points.size()) - 1;
  }

  const Remeshed& mesh_;
  const FacetProjection& projection_;
  std::vector<Polygon> polygons_{};
  std::set<Ends> flat_sides_{};
  std::map<Ends, int> curve_at_{}, middle_of_{};
  Cells cells_{};
};

}  // namespace

Cells quadrilaterals(const Facets& facets, std::optional<double> size, const std::string& name) {
  constexpr double side_of_triangles = 2.2;  // of those that become quadrilaterals with sides of about 1
  const FacetProjection projection(facets);
  Remeshed mesh = size ? remesh(facets, side_of_triangles * *size, name) : as_they_are(facets);
  if (size) untangle(mesh);
  return CellBuilder(mesh, projection).build();
}

}  // namespace plastron::facets

#include <plastron/facets/facets.hpp>

#include <plastron/facets/repair.hpp>
#include <plastron/geometry/file_error.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace plastron::facets {

namespace {

using Triangle = std::array<int, 3>;
using geometry::TriangleSide;

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Divides a surface into faces, and the sides between them into curves.
class Division {
 public:
  explicit Division(Facets& facets) : facets_(facets), mesh_(facets.mesh) {}

  void run() {
    const Sides sides(mesh_);
    find_lines(sides);
    find_faces();
    name_faces();
    find_curves();
    for (const FacetCurve& curve : facets_.curves) add_corners(curve);
    facets_.corners.assign(corners_.begin(), corners_.end());
  }

 private:
  struct Line {
    std::array<int, 2> ends;
    CurveKind kind;
    bool is_used = false;
  };

  void find_lines(const Sides& sides) {
    smooth_.resize(mesh_.triangles.size());
    for (const auto& [begin, end] : sides.ranges) {
      const TriangleSide& side = sides.all[begin];
      const auto kind = end - begin == 1 ? std::optional(CurveKind::border) : kind_of(side, sides.all[begin + 1]);
      if (kind) {
        // A border runs anticlockwise round its triangle.
        const bool is_forward = side.rises || *kind != CurveKind::border;
        for (const int end_point : {side.low, side.high}) lines_at_[end_point].push_back(lines_.size());
        lines_.push_back({is_forward ? std::array{side.low, side.high} : std::array{side.high, side.low}, *kind});
        continue;
      }
      const int a = side.triangle, b = sides.all[begin + 1].triangle;
      smooth_[std::size_t(a)].push_back(b);
      smooth_[std::size_t(b)].push_back(a);
      measure(side, a, b);
    }
    if (turn_.length > 0) facets_.mean_smooth = turn_.angle / turn_.length, facets_.width = turn_.area / turn_.length;
  }

  /// Adds a side within a face to the mean angle and width, unless the two facets are one plane. Two triangles of equal
  /// height over their common side have this height as width: the mean area of both, doubled, over the length.
  void measure(const TriangleSide& side, int a, int b) {
    constexpr double plane = 1e-3;
    const Vector3d first = normal_of(mesh_, mesh_.triangles[a]), second = normal_of(mesh_, mesh_.triangles[b]);
    const double angle = angle_between(first, second);
    if (angle < plane) return;
    const double length = (mesh_.points[side.high] - mesh_.points[side.low]).norm();
    turn_.length += length;
    turn_.angle += length * angle;
    turn_.area += (first.norm() + second.norm()) / 2;
  }

  /// Empty if the two triangles belong to one face.
  std::optional<CurveKind> kind_of(const TriangleSide& a, const TriangleSide& b) {
    const auto normal = [&](const TriangleSide& s) { return normal_of(mesh_, mesh_.triangles[s.triangle]); };
    const double angle = angle_between(normal(a), normal(b));
    if (angle > facets_.smooth_angle * (1 + rounding)) {
      facets_.least_fold = facets_.least_fold > 0 ? std::min(facets_.least_fold, angle) : angle;
      return CurveKind::fold;
    }
    facets_.largest_smooth = std::max(facets_.largest_smooth, angle);
    if (!mesh_.group_of.empty() && mesh_.group_of[a.triangle] != mesh_.group_of[b.triangle]) return CurveKind::seam;
    return {};
  }

  void find_faces() {
    facets_.face_of.assign(mesh_.triangles.size(), -1);
    for (std::size_t seed = 0; seed < mesh_.triangles.size(); ++seed) {
      if (facets_.face_of[seed] >= 0) continue;
      const int face = static_cast<int>(first_of_face_.size());
      first_of_face_.push_back(seed);
      facets_.face_of[seed] = face;
      std::vector<std::size_t> found{seed};
      for (std::size_t i = 0; i < found.size(); ++i)
        for (const int other : smooth_[found[i]])
          if (int& of_other = facets_.face_of[std::size_t(other)]; of_other < 0)
            of_other = face, found.push_back(std::size_t(other));
    }
  }

  void name_faces() {
    int nameless = 0;
    for (const std::size_t first : first_of_face_) {
      const int group = mesh_.group_of.empty() ? -1 : mesh_.group_of[first];
      const bool has_name = group >= 0 && !mesh_.groups[std::size_t(group)].empty();
      facets_.faces.push_back(has_name ? mesh_.groups[std::size_t(group)] : fmt::format("surface {}", ++nameless));
    }
  }

  /// Whether curves end at a point: several lines meet, their kind changes, or they bend.
  bool is_end(int point) const {
    const auto& lines = lines_at_.at(point);
    if (lines.size() != 2) return true;
    const Line &a = lines_[lines[0]], &b = lines_[lines[1]];
    if (a.kind != b.kind) return true;
    return angle_between(mesh_.points[point] - mesh_.points[beyond(a, point)],
                         mesh_.points[beyond(b, point)] - mesh_.points[point]) > sharp_bend;
  }
  static int beyond(const Line& line, int point) { return line.ends[0] == point ? line.ends[1] : line.ends[0]; }

  void find_curves() {
    for (const auto& [point, lines] : lines_at_)
      if (is_end(point)) {
        corners_.insert(point);
        for (const std::size_t line : lines) walk(line, point);
      }
    for (std::size_t line = 0; line < lines_.size(); ++line) walk(line, lines_[line].ends[0]);
  }

  /// Adds the curve of a line that is in none, from one of the line's ends.
  void walk(std::size_t line, int from) {
    if (lines_[line].is_used) return;
    FacetCurve curve{.name = fmt::format("edge {}", facets_.curves.size() + 1), .kind = lines_[line].kind};
    std::size_t forward = 0;
    for (;;) {
      Line& now = lines_[line];
      now.is_used = true;
      forward += now.ends[0] == from ? 1 : 0;
      const int to = beyond(now, from);
      curve.sides.push_back({from, to});
      if (is_end(to)) break;
      const auto& both = lines_at_.at(to);
      line = both[0] == line ? both[1] : both[0];
      if (lines_[line].is_used) break;  // the curve is closed
      from = to;
    }
    if (2 * forward < curve.sides.size()) turn(curve);
    facets_.curves.push_back(std::move(curve));
  }

  static void turn(FacetCurve& curve) {
    std::ranges::reverse(curve.sides);
    for (auto& [from, to] : curve.sides) std::swap(from, to);
  }

  /// Keeps points of a curve so often that it turns by less than `largest_bend` between them, whatever the size of cells.
  void add_corners(const FacetCurve& curve) {
    const auto direction = [&](const std::array<int, 2>& side) {
      return Vector3d(mesh_.points[side[1]] - mesh_.points[side[0]]);
    };
    std::size_t since = 0;
    for (std::size_t i = 1; i < curve.sides.size(); ++i) {
      if (angle_between(direction(curve.sides[since]), direction(curve.sides[i])) <= largest_bend) continue;
      corners_.insert(curve.sides[i][0]);
      since = i;
    }
    if (since > 0) corners_.insert(curve.sides[0][0]);
  }

  static constexpr double sharp_bend = 2 * std::numbers::pi / 9, largest_bend = std::numbers::pi / 6;
  static constexpr double rounding = 1e-6;  // an angle that is just the limit does not exceed it

  Facets& facets_;
  const TriangleMesh& mesh_;
  std::vector<std::vector<int>> smooth_{};  ///< neighbours of each triangle in its face
  std::vector<Line> lines_{};
  std::map<int, std::vector<std::size_t>> lines_at_{};
  std::vector<std::size_t> first_of_face_{};
  std::set<int> corners_{};
  /// Sums over the sides of `measure`.
  struct {
    double length = 0, angle = 0, area = 0;
  } turn_{};
};

}  // namespace

Facets find_facets(TriangleMesh mesh, double smooth_angle, const std::string& name) {
  Facets facets{.mesh = std::move(mesh), .smooth_angle = smooth_angle};
  facets.repeated = remove_repeated(facets.mesh);
  facets.flat = remove_flat(facets.mesh, name);
  if (facets.mesh.triangles.empty()) throw geometry::FileError(name + ": no triangle of the file has an area");
  const Sides sides(facets.mesh);
  check_sides(facets.mesh, sides, name);
  facets.turned = turn_alike(facets.mesh, sides, name);
  Division(facets).run();
  return facets;
}

}  // namespace plastron::facets
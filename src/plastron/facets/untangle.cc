#include <plastron/facets/triangles.hpp>
#include <plastron/facets/untangle.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace plastron::facets {

namespace {

using Triangle = std::array<int, 3>;

/// A change of some triangles around a side.
struct Change {
  std::vector<std::pair<std::size_t, Triangle>> triangles{};  ///< new corners; two equal ones: the triangle is removed
  std::optional<std::pair<int, Vector3d>> moved{};            ///< a corner and its new place
  double folding = 0;                                         ///< folding_around() afterwards
};

/// The triangles with their neighbours, and the changes that lessen the angles between neighbours.
class Untangling {
 public:
  explicit Untangling(Remeshed& mesh) : mesh_(mesh) {
    for (const Remeshed::Line& line : mesh.lines) {
      lines_.insert(ascending(line.ends[0], line.ends[1]));
      on_lines_.insert(line.ends.begin(), line.ends.end());
    }
    around_.resize(mesh.points.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) add(t);
  }

  /// Mends the worst side of each neighbourhood once. Returns whether there was something to mend.
  bool round() {
    std::vector<std::pair<double, Ends>> folded;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const Ends& side : sides_of(mesh_.triangles[t]))
        if (const auto both = triangles_at(side); both && (*both)[0] == t)
          if (const double c = cosine(normal((*both)[0]), normal((*both)[1])); c < folded_cosine)
            folded.emplace_back(c, side);
    std::ranges::sort(folded, {}, [](const auto& one) { return std::pair(one.first, one.second); });
    bool has_changed = false;
    for (const auto& [c, side] : folded) has_changed = mend(side) || has_changed;
    return has_changed;
  }

  /// Removes triangles and points that are no longer used.
  void finish() {
    Remeshed kept{.lines = std::move(mesh_.lines)};
    std::vector<int> number(mesh_.points.size(), -1);
    const auto renumbered = [&](int point) {
      if (number[point] < 0) {
        number[point] = static_cast<int>(kept.points.size());
        kept.points.push_back(mesh_.points[point]);
      }
      return number[point];
    };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      if (a == b || b == c || c == a) continue;
      kept.triangles.push_back({renumbered(a), renumbered(b), renumbered(c)});
      kept.face_of.push_back(mesh_.face_of[t]);
    }
    for (Remeshed::Line& line : kept.lines)
      for (int& end : line.ends) end = renumbered(end);
    mesh_ = std::move(kept);
  }

 private:
  /// The cosine of the largest angle between neighbours; the directors of a shell allow 80 degrees on each side.
  static constexpr double folded_cosine = 0.1;

  static std::array<Ends, 3> sides_of(const Triangle& t) {
    return {ascending(t[0], t[1]), ascending(t[1], t[2]), ascending(t[2], t[0])};
  }
  static bool has(const Triangle& t, int point) { return std::ranges::find(t, point) != t.end(); }
  static Triangle replaced(Triangle t, int from, int to) {
    std::ranges::replace(t, from, to);
    return t;
  }
  static double cosine(const Vector3d& a, const Vector3d& b) {
    const double size = a.norm() * b.norm();
    return size > 0 ? a.dot(b) / size : -1;
  }

  Vector3d normal(const Triangle& t) const {
    return (mesh_.points[t[1]] - mesh_.points[t[0]]).cross(mesh_.points[t[2]] - mesh_.points[t[0]]);
  }
  Vector3d normal(std::size_t t) const { return normal(mesh_.triangles[t]); }

  void add(std::size_t t) {
    for (const int corner : mesh_.triangles[t]) around_[corner].insert(t);
  }
  void remove(std::size_t t) {
    for (const int corner : mesh_.triangles[t]) around_[corner].erase(t);
  }

  /// The two triangles at a side within a face.
  std::optional<std::array<std::size_t, 2>> triangles_at(const Ends& side) const {
    if (lines_.contains(side)) return {};
    std::vector<std::size_t> both;
    for (const std::size_t t : around_[side[0]])
      if (has(mesh_.triangles[t], side[1])) both.push_back(t);
    return both.size() == 2 ? std::optional(std::array{both[0], both[1]}) : std::nullopt;
  }

  std::set<int> neighbours(int point) const {
    std::set<int> all;
    for (const std::size_t t : around_[point]) all.insert(mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    all.erase(point);
    return all;
  }

  void apply(const Change& change) {
    for (const auto& [t, corners] : change.triangles) {
      remove(t);
      mesh_.triangles[t] = corners;
      if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) add(t);
    }
    if (change.moved) mesh_.points[change.moved->first] = change.moved->second;
  }

  /// The sum of what cosines between neighbours lack, at the sides of the triangles around some points.
  double folding_around(const std::set<int>& points) const {
    std::set<std::size_t> triangles;
    for (const int point : points) triangles.insert(around_[point].begin(), around_[point].end());
    double sum = 0;
    for (const std::size_t t : triangles)
      for (const Ends& side : sides_of(mesh_.triangles[t]))
        if (const auto both = triangles_at(side))
          sum += std::max(0.0, folded_cosine - cosine(normal((*both)[0]), normal((*both)[1])));
    return sum;
  }

  /// Makes a change, measures it and takes it back.
  void measure(Change& change, const std::set<int>& points) {
    Change back;
    for (const auto& [t, corners] : change.triangles) back.triangles.emplace_back(t, mesh_.triangles[t]);
    if (change.moved) back.moved = std::pair(change.moved->first, mesh_.points[change.moved->first]);
    apply(change);
    change.folding = folding_around(points);
    apply(back);
  }

  std::vector<Change> turned(const std::array<std::size_t, 2>& both, const Ends& side, int c, int d) const {
    if (neighbours(c).contains(d)) return {};
    const Triangle &first = mesh_.triangles[both[0]], &second = mesh_.triangles[both[1]];
    // first has c: its corner side[0] becomes d; second has d: its corner side[1] becomes c.
    return {{.triangles = {{both[0], replaced(first, side[0], d)}, {both[1], replaced(second, side[1], c)}}}};
  }

  /// Moves a corner to the middle of its neighbours, or halfway.
  std::vector<Change> moved(int point) const {
    Vector3d mean = Vector3d::Zero();
    const std::set<int> all = neighbours(point);
    for (const int other : all) mean += mesh_.points[other] / static_cast<double>(all.size());
    return {{.moved = std::pair(point, mean)}, {.moved = std::pair(point, Vector3d((mean + mesh_.points[point]) / 2))}};
  }

  /// Puts a corner onto each neighbour with which it has two common neighbours.
  std::vector<Change> joined(int point) const {
    std::vector<Change> changes;
    const std::set<int> own = neighbours(point);
    for (const int other : own) {
      std::set<int> common;
      std::ranges::set_intersection(own, neighbours(other), std::inserter(common, common.end()));
      if (common.size() != 2 || around_[point].size() < 3) continue;
      Change& change = changes.emplace_back();
      for (const std::size_t t : around_[point])
        change.triangles.emplace_back(t, replaced(mesh_.triangles[t], point, other));
    }
    return changes;
  }

  bool mend(const Ends& side) {
    const auto both = triangles_at(side);
    if (!both) return false;
    const auto opposite = [&](std::size_t t) {
      for (const int corner : mesh_.triangles[t])
        if (corner != side[0] && corner != side[1]) return corner;
      return -1;
    };
    const std::set<int> corners{side[0], side[1], opposite((*both)[0]), opposite((*both)[1])};
    std::set<int> points = corners;
    for (const int corner : corners) points.merge(neighbours(corner));
    const double before = folding_around(points);
    if (!(before > 0)) return false;
    std::vector<Change> changes = turned(*both, side, opposite((*both)[0]), opposite((*both)[1]));
    for (const int corner : corners) {
      if (on_lines_.contains(corner)) continue;
      std::ranges::move(moved(corner), std::back_inserter(changes));
      std::ranges::move(joined(corner), std::back_inserter(changes));
    }
    for (Change& change : changes) measure(change, points);
    const auto best = std::ranges::min_element(changes, {}, &Change::folding);
    constexpr double gain = 1e-3;
    if (best == changes.end() || !(best->folding < before - gain)) return false;
    apply(*best);
    return true;
  }

  Remeshed& mesh_;
  std::set<Ends> lines_{};
  std::set<int> on_lines_{};
  std::vector<std::set<std::size_t>> around_{};  ///< the triangles around each point
};

}  // namespace

void untangle(Remeshed& mesh) {
  constexpr int most_rounds = 30;
  Untangling untangling(mesh);
  bool has_changed = false;
  for (int round = 0; round < most_rounds && untangling.round(); ++round) has_changed = true;
  if (has_changed) untangling.finish();
}

}  // namespace plastron::facets

#include <plastron/facets/triangle_pairs.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace plastron::facets {

namespace {

using Eigen::Vector3d;
using Triangles = std::vector<std::array<int, 3>>;

struct Candidate {
  double skewness;  ///< largest difference of an angle from a right one [rad]
  TrianglePair pair;
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
void add_candidate(const std::vector<Vector3d>& points, const Triangles& triangles,
                   const std::array<std::size_t, 2>& both, std::size_t k, std::vector<Candidate>& candidates) {
  constexpr double most_skew = std::numbers::pi / 3;
  const auto &t = triangles[both[0]], &o = triangles[both[1]];
  const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
  int d = o[0];
  for (const int corner : o)
    if (corner != a && corner != b) d = corner;
  const std::array corners{a, d, b, c};
  const auto normal = [&](int p, int q, int r) {
    return Vector3d((points[q] - points[p]).cross(points[r] - points[p]));
  };
  // Each of the two other triangles of the quadrilateral must be turned alike, too: else it has an angle above 180 degrees.
  const Vector3d mean = normal(a, b, c) + normal(a, d, b);
  if (normal(a, d, c).dot(mean) <= 0 || normal(d, b, c).dot(mean) <= 0) return;
  const double skewness = skewness_of(corners, points);
  if (skewness < most_skew) candidates.push_back({skewness, {both, corners}});
}

}  // namespace

std::vector<TrianglePair> triangle_pairs(const std::vector<Vector3d>& points, const Triangles& triangles,
                                         const std::function<bool(const Ends&)>& is_curve,
                                         const std::function<bool(const std::array<int, 4>&)>& may_pair) {
  std::map<Ends, std::vector<std::pair<std::size_t, std::size_t>>> at_side;  // triangle and corner
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      at_side[ascending(triangles[t][k], triangles[t][(k + 1) % 3])].emplace_back(t, k);
  std::vector<Candidate> candidates;
  for (const auto& [ends, both] : at_side)
    if (both.size() == 2 && !is_curve(ends))
      add_candidate(points, triangles, {both[0].first, both[1].first}, both[0].second, candidates);
  std::ranges::sort(candidates, {}, [](const Candidate& c) { return std::tuple(c.skewness, c.pair.triangles); });
  std::vector<bool> is_used(triangles.size(), false);
  std::vector<TrianglePair> pairs;
  for (const Candidate& candidate : candidates) {
    const auto& [first, second] = candidate.pair.triangles;
    if (is_used[first] || is_used[second] || (may_pair && !may_pair(candidate.pair.corners))) continue;
    is_used[first] = is_used[second] = true;
    pairs.push_back(candidate.pair);
  }
  return pairs;
}

}  // namespace plastron::facets

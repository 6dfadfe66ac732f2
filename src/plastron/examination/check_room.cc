// Checks that obstacles leave the thickness of the shell free between them, at the start and at each instant.
#include <plastron/examination/checks.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/problem/instants.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace plastron::examination {

namespace {

/// The place where two obstacles leave least of the thickness free.
struct Room {
  std::size_t node = 0;
  double room = 0, missing = 0;  ///< [m]
};

/// The room at a node between two obstacles that face each other across the shell; empty if they do not.
std::optional<double> room_at(const obstacle::Obstacle& one, const obstacle::Obstacle& other,
                              const assembly::NodalPoint& point) {
  constexpr double face_each_other = -0.99, across_shell = 0.5;  // cosines
  try {
    const obstacle::Nearest a = one.nearest(point.phi), b = other.nearest(point.phi);
    if (a.normal.dot(b.normal) > face_each_other || std::abs(a.normal.dot(point.a3)) < across_shell) return {};
    return a.distance + b.distance;
  } catch (const obstacle::ObstacleError&) {
    return {};  // the distance has no direction there
  }
}

Room least_room(const obstacle::Obstacle& one, const obstacle::Obstacle& other, const ExaminedNodes& nodes) {
  const bool are_planes = one.is_plane() && other.is_plane();  // their distance is the same everywhere
  constexpr double rounding = 1e-9;
  Room least;
  for (std::size_t i = 0; i < nodes.points.size(); ++i) {
    const assembly::NodalPoint& point = nodes.points[i];
    const auto room = room_at(one, other, point);
    // An obstacle around the node does not face the other one across the shell.
    if (!room || (!are_planes && *room <= 0)) continue;
    const double missing = point.thickness - *room;
    if (missing > std::max(least.missing, rounding * point.thickness))
      least = {.node = i, .room = *room, .missing = missing};
  }
  return least;
}

/// The instants that are checked: all for planes, the first and the last one for others.
std::vector<double> times(const problem::Problem& problem, bool are_planes) {
  std::vector<double> all{0};
  for (const problem::Instant& instant : problem::instants(problem))
    if (instant.factors.time > all.back()) all.push_back(instant.factors.time);
  if (!are_planes && all.size() > 2) all = {all.front(), all.back()};
  return all;
}

void check_pair(Examined& examined, const ExaminedNodes& nodes, std::size_t first, std::size_t second) {
  const problem::Problem& problem = examined.problem;
  const obstacle::Obstacle &one = problem.shell.obstacles.all[first], &other = problem.shell.obstacles.all[second];
  const bool are_planes = one.is_plane() && other.is_plane();
  for (const double time : times(problem, are_planes)) {
    const Room least = least_room(one.standing(time), other.standing(time), nodes);
    if (least.missing == 0) continue;
    examined.add(
        are_planes ? Severity::error : Severity::warning,
        "{} and {} leave {:.4g} m free between them at {}{}, and the shell is {:.4g} m thick there, {:.2g} m more; "
        "move them apart, or make the shell thinner",
        obstacle_text(problem, first), obstacle_text(problem, second), std::max(least.room, 0.0),
        examined.place(nodes.points[least.node].x), problem.steps.empty() ? "" : fmt::format(", time {:.4g}", time),
        nodes.points[least.node].thickness, least.missing);
    return;
  }
}

}  // namespace

void check_room(Examined& examined, const ExaminedNodes& nodes) {
  const auto& obstacles = examined.problem.shell.obstacles.all;
  for (std::size_t i = 0; i < obstacles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto is_checked = [](const obstacle::Obstacle& o) {
        return !o.is_pressed() && !o.has_bed() && has_fast_distance(o);
      };
      if (is_checked(obstacles[i]) && is_checked(obstacles[j])) check_pair(examined, nodes, j, i);
    }
}

}  // namespace plastron::examination

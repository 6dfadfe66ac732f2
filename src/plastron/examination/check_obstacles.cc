// Checks the obstacles: their surfaces, their sides and the faces of the shell that will touch.
// - Where the obstacle is near, the nearer face must touch: otherwise the shell ends one thickness inside the obstacle.
//   Far from it, as on the upper half of a tube on a table, either face may be nearer.
// - Deep inside a body the nearest way out may change its side from node to node, as in the middle of a slab. Then gaps
//   push one cell to both sides, and the free side is arbitrary. Outside the body such a jump is harmless.
#include <plastron/examination/checks.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace plastron::examination {

namespace {

using obstacle::Face;

/// Returns the cosine of the angle between a_3 and the obstacle's normal, positive where the named face is the nearer
/// one.
double facing(const obstacle::Gap& gap, const assembly::NodalPoint& point, Face face) {
  const double cosine = gap.normal.dot(point.a3);
  return face == Face::lower ? cosine : -cosine;
}

/// The node where either face is nearest, and the position of the faces around it.
struct Nearest {
  std::size_t node = 0;
  double facing = 0;  ///< mean over the places that are at most a thickness farther away
};

Nearest nearest(const ExaminedNodes& nodes, std::size_t obstacle, Face face) {
  const std::size_t count = nodes.points.size();
  std::vector<double> cosines(count), gaps(count);
  for (std::size_t i = 0; i < count; ++i) {
    const obstacle::Gap& gap = nodes.coordinates.gaps[obstacle][i];
    cosines[i] = facing(gap, nodes.points[i], face);
    // The other face is nearer by 2 |arm| |cosine| where the cosine is negative.
    gaps[i] = gap.initial + std::min(0.0, 2 * std::abs(gap.arm) * cosines[i]);
  }
  const auto least = static_cast<std::size_t>(std::ranges::min_element(gaps) - gaps.begin());
  double weights = 0, sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (gaps[i] > gaps[least] + nodes.points[i].thickness) continue;
    weights += nodes.points[i].weight;
    sum += nodes.points[i].weight * cosines[i];
  }
  return {least, weights > 0 ? sum / weights : cosines[least]};
}

/// Reports the face that can touch where the choice is made at each node.
void note_faces(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle) {
  const auto& gaps = nodes.coordinates.gaps[obstacle];
  const auto lower = std::ranges::count_if(gaps, [](const obstacle::Gap& gap) { return gap.z < 0; });
  const auto all = static_cast<std::ptrdiff_t>(gaps.size());
  const std::string which = lower == all ? "the lower face" : lower == 0 ? "the upper face" : "";
  if (!which.empty())
    return examined.add(Severity::note, "face: {} looks at {}", which, obstacle_text(examined.problem, obstacle));
  const auto nearest =
      static_cast<std::size_t>(std::ranges::min_element(gaps, {}, &obstacle::Gap::initial) - gaps.begin());
  examined.add(
      Severity::note,
      "face: on {:.0f} % of the nodes the lower face looks at {}, on the rest the upper one; nearest is the {} "
      "face at {}",
      100.0 * static_cast<double>(lower) / static_cast<double>(all), obstacle_text(examined.problem, obstacle),
      gaps[nearest].z < 0 ? "lower" : "upper", examined.place(nodes.points[nearest].x));
}

/// Limit of the cosine between normals that push to opposite sides: 120 degrees.
constexpr double opposite = -0.5;

/// Returns two nodes of one cell inside the obstacle that it pushes to opposite sides.
std::optional<std::pair<std::size_t, std::size_t>> pushed_apart(const Examined& examined,
                                                                const std::vector<obstacle::Gap>& gaps, double inside) {
  for (std::size_t cell = 0; cell < examined.space->cells.size(); ++cell) {
    const auto nodes = examined.space->nodes(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i && gaps[nodes[i]].initial < inside; ++j)
        if (gaps[nodes[j]].initial < inside && gaps[nodes[i]].normal.dot(gaps[nodes[j]].normal) < opposite)
          return std::pair(nodes[j], nodes[i]);
  }
  return {};
}

}  // namespace

void check_face(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle) {
  // Within 6 degrees of a right angle the distances of the faces differ by less than a tenth of e.
  constexpr double alike = 0.1;
  const obstacle::Obstacle& body = examined.problem.shell.obstacles.all[obstacle];
  const Face face = body.face;
  if (body.is_for_both) return;  // no check: the other face may touch the same body
  if (face == Face::nearer) return note_faces(examined, nodes, obstacle);
  const Nearest near = nearest(nodes, obstacle, face);
  const auto& point = nodes.points[near.node];
  const bool is_lower = face == Face::lower;
  const char *named = is_lower ? "lower" : "upper", *other = is_lower ? "upper" : "lower";
  const double nearer = point.thickness * std::abs(facing(nodes.coordinates.gaps[obstacle][near.node], point, face));
  const std::string a3 = vector_text(point.a3);
  if (near.facing < -alike)
    return examined.add(
        Severity::error,
        "the {0} face is to touch {6}, but it is the far one: where the shell is nearest, at {1}, a_3 = {2} "
        "points {3} it and the {4} face is {5:.4g} m nearer; write face = \"{4}\", or turn a_3 round by "
        "exchanging x and y in the chart",
        named, examined.place(point.x), a3, is_lower ? "to" : "away from", other, nearer,
        obstacle_text(examined.problem, obstacle));
  if (near.facing < alike)
    return examined.add(Severity::note, "face: a_3 = {} at the nearest point, both faces are about equally near", a3);
  examined.add(Severity::note,
               "face: a_3 = {} at the nearest point, the {} face is {:.4g} m nearer to the obstacle than the {} one",
               a3, named, nearer, other);
}

void check_sides(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle) {
  const auto& gaps = nodes.coordinates.gaps[obstacle];
  const auto pair = pushed_apart(examined, gaps, -1e-9 * examined.size);
  if (!pair) return;
  const auto [a, b] = *pair;
  examined.add(
      Severity::warning,
      "it is not clear which side of {} is the free one: the way out of it that is nearest is along {} at {}, "
      "but along {} at {} beside it, and the shell is pushed both ways; let all of the shell that is inside be "
      "nearer to one side, or let the obstacle come in by [[step]]s",
      obstacle_text(examined.problem, obstacle), vector_text(gaps[a].normal), examined.place(nodes.points[a].x),
      vector_text(gaps[b].normal), examined.place(nodes.points[b].x));
}

void check_surfaces(Examined& examined) {
  for (std::size_t k = 0; k < examined.problem.shell.obstacles.all.size(); ++k) {
    const auto* surface = std::get_if<obstacle::TriangleSurface>(&examined.problem.shell.obstacles.all[k].shape);
    if (!surface || surface->mesh().joined == 0) continue;
    examined.add(
        Severity::note,
        "surface of {}: {} corners at open sides were joined with others up to {:.2g} m away (allowed: {:g} of "
        "the surface's size)",
        obstacle_text(examined.problem, k), surface->mesh().joined, surface->mesh().joined_over,
        geometry::joining_tolerance);
  }
}

}  // namespace plastron::examination

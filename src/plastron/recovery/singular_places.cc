#include <plastron/recovery/singular_places.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/solution/contact_faces.hpp>
#include <plastron/solution/contact_width.hpp>
#include <plastron/solution/place_order.hpp>
#include <plastron/solution/summary.hpp>

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

namespace plastron::recovery {

namespace {

/// The part of a field's components that an edge fixes.
enum class Hold { nothing, some, all };
/// For displacements in the tangent plane, for the rotation, for the deflection.
using Holds = std::array<Hold, 3>;

/// A side of the rim, seen from one of its two corners.
struct SideEnd {
  algebra::GlobalIndex node = 0;
  bool is_forward = false;  ///< anticlockwise round the shell
  int boundary = -1;
  Holds holds{};
  Vector3d tangent = Vector3d::Zero(), a3 = Vector3d::Zero(), position = Vector3d::Zero();
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double thickness = 0;
};

/// Sums of d d' over the directions in which a boundary's supports fix u and r at a place with these axes.
std::array<Eigen::Matrix3d, 2> held_directions(const assembly::DiscreteShell& discrete, const std::string& boundary,
                                               const geometry::Place& place, const Vector3d& tangent,
                                               const Vector3d& a3) {
  std::array<Eigen::Matrix3d, 2> sums{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  const auto vector = [&](const assembly::Support& support, assembly::Direction direction) -> Vector3d {
    if (const auto in_space = direction_at(support, direction, place)) return *in_space;
    if (direction == assembly::Direction::normal) return a3;
    return direction == assembly::Direction::tangent ? tangent : tangent.cross(a3);
  };
  for (const assembly::Support& support : discrete.supports)
    if (!support.point && support.boundary == boundary)
      for (const assembly::PrescribedComponent& c : support.components) {
        const Vector3d d = vector(support, c.direction);
        sums[c.unknown == assembly::Unknown::displacement ? 0 : 1] += d * d.transpose();
      }
  return sums;
}

/// The number of fixed directions of the tangent plane, regardless of other directions fixed with them.
Hold held_in_plane(const Eigen::Matrix3d& sum, const Vector3d& t, const Vector3d& n) {
  Eigen::Matrix2d plane;
  plane << t.dot(sum * t), t.dot(sum * n), n.dot(sum * t), n.dot(sum * n);
  constexpr double least = 0.1;  // limit of a squared cosine
  const double trace = plane.trace(), root = std::sqrt(std::max(0.0, trace * trace / 4 - plane.determinant()));
  return trace / 2 - root > least ? Hold::all : trace / 2 + root > least ? Hold::some : Hold::nothing;
}

void add_ends(const assembly::DiscreteShell& discrete, const fem::BoundarySide& side, std::vector<SideEnd>& ends) {
  const fem::Space& space = discrete.space();
  const auto corners = mesh::anticlockwise_corners(space.shape(), side.side);
  const auto on_side = mesh::side_nodes(space.shape(), space.degree, side.side);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d from = mesh::corner(space.shape(), corners[static_cast<std::size_t>(k)]),
                          to = mesh::corner(space.shape(), corners[static_cast<std::size_t>(1 - k)]);
    const geometry::Frame frame = discrete.shell.surface().frame(space.cells[side.cell], from, false);
    const bool is_first = (from - mesh::side_point(space.shape(), side.side, 0)).norm() < 0.5;
    const auto node = static_cast<std::size_t>(
        space.nodes(side.cell)[static_cast<std::size_t>(is_first ? on_side.front() : on_side.back())]);
    if (space.continuity.constrains(node)) continue;
    SideEnd end{.node = space.layout->global(static_cast<algebra::LocalIndex>(node)),
                .is_forward = k == 0,
                .boundary = side.boundary,
                .tangent = geometry::along(frame, to - from).normalized(),
                .a3 = frame.a3,
                .position = frame.phi,
                .at = discrete.points[node].x,
                .thickness = discrete.points[node].thickness};
    if (side.boundary >= 0) {
      const auto held = held_directions(discrete, space.coarse->boundaries[static_cast<std::size_t>(side.boundary)],
                                        {end.at[0], end.at[1], end.position[0], end.position[1], end.position[2]},
                                        end.tangent, end.a3);
      const Vector3d n = end.tangent.cross(end.a3);
      end.holds = {held_in_plane(held[0], end.tangent, n), held_in_plane(held[1], end.tangent, n),
                   end.a3.dot(held[0] * end.a3) > 0.1 ? Hold::all : Hold::nothing};
    }
    ends.push_back(end);
  }
}

/// The largest angle between two edges at which stresses are bounded [rad].
double bounded_up_to(const Holds& a, const Holds& b) {
  constexpr double pi = std::numbers::pi, held_and_free = 63 * pi / 180;
  double least = pi;
  for (std::size_t field = 0; field < a.size(); ++field) {
    const bool is_deflection = field == 2;
    if (a[field] == Hold::some || b[field] == Hold::some)
      least = std::min(least, pi / 2);
    else if (a[field] != b[field])
      least = std::min(least, is_deflection ? pi / 2 : held_and_free);
  }
  return least;
}

/// One of the two edges, with the constraints of all its names: a side may have several.
SideEnd joined(const std::vector<SideEnd>& ends, bool is_forward) {
  SideEnd whole;
  for (const SideEnd& end : ends) {
    if (end.is_forward != is_forward) continue;
    const Holds before = whole.holds;
    whole = end;
    for (std::size_t k = 0; k < before.size(); ++k) whole.holds[k] = std::max(before[k], end.holds[k]);
  }
  return whole;
}

std::vector<SingularPlace> singular_corners(const assembly::DiscreteShell& discrete) {
  const fem::Space& space = discrete.space();
  std::vector<SideEnd> mine;
  for (const fem::BoundarySide& side : space.sides)
    if (side.cell < space.owned_cells && !side.is_inner) add_ends(discrete, side, mine);
  std::map<algebra::GlobalIndex, std::vector<SideEnd>> by_node;
  for (const SideEnd& end : algebra::gathered(mine, space.layout->comm)) by_node[end.node].push_back(end);
  std::vector<SingularPlace> places;
  for (const auto& [node, ends] : by_node) {
    const SideEnd forward = joined(ends, true), backward = joined(ends, false);
    if (forward.a3.isZero(0) || backward.a3.isZero(0)) continue;
    const double sine = forward.a3.dot(forward.tangent.cross(backward.tangent)),
                 cosine = forward.tangent.dot(backward.tangent);
    // In radians: straight sides of cells approximate a smooth curve by a polygon.
    constexpr double rounding = 1e-2, smooth = 0.15;
    double angle = std::atan2(sine, cosine);
    if (angle < rounding) angle += 2 * std::numbers::pi;
    const bool is_change = forward.holds != backward.holds;
    const bool is_corner = std::abs(angle - std::numbers::pi) > smooth;
    if (!is_change && !is_corner) continue;
    if (angle <= bounded_up_to(forward.holds, backward.holds) + smooth) continue;
    places.push_back(
        {.what = fmt::format("{}{}",
                             is_change && is_corner     ? "corner where supports change"
                             : is_change                ? "end of a support"
                             : angle > std::numbers::pi ? "re-entrant corner"
                                                        : "corner",
                             is_corner ? fmt::format(" of {:.0f} degrees", angle * 180 / std::numbers::pi) : ""),
         .at = forward.at,
         .position = forward.position,
         .radius = forward.thickness});
  }
  return places;
}

/// A node that touches an obstacle in a line or point of contact.
struct NarrowNode {
  double force = 0;  ///< of the obstacle [N]
  Eigen::Vector2d at;
  Vector3d position;
  double radius = 0;  ///< the thickness, or half of the distance of nodes if that is more [m]
};

/// Returns the nodes of all ranks in lines and points of contact with an obstacle, first the one with the largest force
/// (collective).
std::vector<NarrowNode> narrow_nodes(const assembly::DiscreteShell& discrete, const solution::ContactFaces& faces,
                                     const algebra::Vector& with_area, std::size_t obstacle) {
  const std::size_t obstacles = discrete.obstacles.all.size();
  const std::vector<char> on_edges = solution::nodes_on_edges(discrete);  // a line of contact there is an ordinary load
  std::vector<NarrowNode> mine;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const std::size_t at = i * obstacles + obstacle;
    if (on_edges[i] != 0) continue;
    if (!(faces.touching.local()[at] > 0.5) || with_area.local()[at] > 0) continue;
    const assembly::NodalPoint& p = discrete.points[i];
    mine.push_back(
        {faces.pressure.local()[at] * p.side_weight, p.x, p.phi, std::max(p.thickness, std::sqrt(p.weight) / 2)});
  }
  std::vector<NarrowNode> nodes = algebra::gathered(mine, discrete.space().layout->comm);
  constexpr double same = 1 - 1e-6;
  double largest = 0;
  for (const NarrowNode& node : nodes) largest = std::max(largest, node.force);
  const auto first = [&](const NarrowNode& node) {
    return std::array{node.force >= same * largest ? 0.0 : 1.0, node.at[0], node.at[1]};
  };
  std::ranges::sort(nodes, {}, first);
  return nodes;
}

/// Returns one place for each obstacle that touches the shell along lines or at points.
std::vector<SingularPlace> narrow_contact(const assembly::DiscreteShell& discrete,
                                          const solution::NodalSolution& solution) {
  std::vector<SingularPlace> places;
  if (discrete.obstacles.empty()) return places;
  const solution::ContactFaces faces = solution::contact_faces(discrete, solution);
  const algebra::Vector with_area = solution::ContactWidth(discrete, faces.touching).with_area();
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) {
    const std::vector<NarrowNode> nodes = narrow_nodes(discrete, faces, with_area, k);
    if (nodes.empty()) continue;
    const std::string& name = discrete.obstacles.all[k].name;
    SingularPlace& place = places.emplace_back(
        SingularPlace{.what = fmt::format("{} of contact{}", nodes.size() == 1 ? "point" : "line or points",
                                          name.empty() ? "" : fmt::format(" with \"{}\"", name)),
                      .at = nodes.front().at,
                      .position = nodes.front().position});
    for (const NarrowNode& node : nodes) {
      place.radius = std::max(place.radius, node.radius);
      if (&node != &nodes.front()) place.others.push_back(node.position);
    }
  }
  return places;
}

}  // namespace

std::vector<SingularPlace> singular_places(const assembly::DiscreteShell& discrete,
                                           const solution::NodalSolution& solution, const solution::Summary& summary) {
  std::vector<SingularPlace> places = singular_corners(discrete);
  std::ranges::move(narrow_contact(discrete, solution), std::back_inserter(places));
  // Part of all forces: smaller forces belong to points that only prevent rigid motions.
  constexpr double negligible = 1e-6;
  for (const solution::PointReaction& point : summary.point_reactions) {
    if (point.force.norm() <= negligible * summary.force_scale()) continue;
    std::vector<std::pair<Vector3d, double>> mine;  // positions and thicknesses
    for (const auto node : assembly::owned_nodes_at(discrete.space(), discrete.points, point.at)) {
      const assembly::NodalPoint& p = discrete.points[static_cast<std::size_t>(node)];
      mine.emplace_back(p.phi, p.thickness);
    }
    for (const auto& [position, thickness] : algebra::gathered(mine, discrete.space().layout->comm))
      places.push_back({.what = "support at a point", .at = point.at, .position = position, .radius = thickness});
  }
  std::ranges::stable_sort(
      places, {}, [&](const SingularPlace& place) { return solution::in_units(place.position, summary.size); });
  return places;
}

}  // namespace plastron::recovery

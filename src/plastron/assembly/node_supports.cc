// Converts supports by boundary or point and component to prescribed directions at nodes.
#include <plastron/assembly/nodal_coordinates.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/assembly/constrained_supports.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace plastron::assembly {

namespace {

struct EdgeFrame {
  Vector3d conormal, tangent;
};

/// Frames of the boundary curves that meet at a node. Pieces of one smooth curve give one averaged frame. At a corner
/// of the curve both directions are kept.
class EdgeFrames {
 public:
  void add(const EdgeFrame& frame) {
    // One degree. Sides of a smooth curve meet without an angle in the exact maps of the built-in domains.
    // In a mesh of second order their angle is below this limit up to an arc of 30 degrees for each side.
    // A larger angle is a corner, where the domain has two conormals. If only their mean were fixed, the shell would
    // slide in the other direction.
    constexpr double corner = 0.0175;
    for (EdgeFrame& known : frames_)
      if ((known.conormal - frame.conormal).norm() < corner) {
        known.conormal = (known.conormal + frame.conormal).normalized();
        known.tangent = (known.tangent + frame.tangent).normalized();
        return;
      }
    frames_.push_back(frame);
  }
  const std::vector<EdgeFrame>& all() const { return frames_; }

 private:
  std::vector<EdgeFrame> frames_;
};

/// Returns the outward conormal and the tangent (anticlockwise around the domain) on a side of a cell along
/// `side_tangent`.
EdgeFrame edge_frame(const geometry::Frame& frame, const Eigen::Vector2d& side_tangent) {
  const Vector3d tangent = geometry::along(frame, side_tangent).normalized();
  return {tangent.cross(frame.a3).normalized(), tangent};
}

std::vector<Vector3d> directions(const Support& support, Direction direction, const NodalPoint& point,
                                 const EdgeFrames& edges) {
  const geometry::Place place{point.x[0], point.x[1], point.phi[0], point.phi[1], point.phi[2]};
  if (const auto in_space = direction_at(support, direction, place)) return {*in_space};
  if (direction == Direction::normal) return {point.a3};
  std::vector<Vector3d> all;
  for (const EdgeFrame& frame : edges.all())
    all.push_back(direction == Direction::conormal ? frame.conormal : frame.tangent);
  return all;
}

/// The edge frames of one boundary at the owned nodes on it, by local node.
class FramesOn {
 public:
  FramesOn(const fem::Space& space, const fem::Surface& surface, int boundary)
      : space_(space), surface_(surface), slot_(static_cast<std::size_t>(space.layout->owned), -1) {
    for (const fem::BoundarySide& side : space.sides)
      if (side.boundary == boundary) add(side, false);
    for (const fem::BoundarySide& side : space.twin_sides)
      if (side.boundary == boundary) add(side, true);
  }
  std::vector<std::pair<algebra::LocalIndex, EdgeFrames>> take() { return std::move(frames_); }

 private:
  /// `is_twin`: the side runs in the opposite direction.
  void add(const fem::BoundarySide& edge, bool is_twin) {
    const auto line = mesh::gauss_lobatto(space_.degree + 1).points;  // the nodes of a side on either shape
    std::vector<Eigen::Vector2d> xi;
    xi.reserve(line.size());
    for (const double t : line) xi.push_back(mesh::side_point(space_.shape(), edge.side, t));
    std::vector<geometry::Frame> frames(xi.size());
    surface_.frames(space_.cells[edge.cell], xi, frames, false);
    const auto on_side = mesh::side_nodes(space_.shape(), space_.degree, edge.side);
    const Eigen::Vector2d tangent = (is_twin ? -1 : 1) * mesh::side_tangent(space_.shape(), edge.side);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      const algebra::LocalIndex node = space_.nodes(edge.cell)[static_cast<std::size_t>(on_side[i])];
      if (node >= space_.layout->owned) continue;
      int& s = slot_[static_cast<std::size_t>(node)];
      if (s < 0) {
        s = static_cast<int>(frames_.size());
        frames_.emplace_back(node, EdgeFrames{});
      }
      frames_[static_cast<std::size_t>(s)].second.add(edge_frame(frames[i], tangent));
    }
  }

  const fem::Space& space_;
  const fem::Surface& surface_;
  std::vector<int> slot_;
  std::vector<std::pair<algebra::LocalIndex, EdgeFrames>> frames_{};
};

}  // namespace

namespace {

/// The rows that one support adds at the nodes of its boundary.
class Rows {
 public:
  Rows(const Support& support, const std::vector<NodalPoint>& points, double factor)
      : support_(support), points_(points), factor_(factor) {}

  void add(algebra::LocalIndex node, const EdgeFrames& edges, NodeSupport& at_node) {
    const NodalPoint& p = points_[static_cast<std::size_t>(node)];
    for (const PrescribedComponent& component : support_.components) {
      const double value = component.value({p.x[0], p.x[1], p.phi[0], p.phi[1], p.phi[2]});
      double& largest = component.unknown == Unknown::displacement ? displacement_ : rotation_;
      largest = std::max(largest, std::abs(value));
      auto& rows = component.unknown == Unknown::displacement ? at_node.displacement : at_node.rotation;
      for (const Vector3d& d : directions(support_, component.direction, p, edges))
        rows.emplace_back(d, factor_ * value);
    }
  }

  double largest(Unknown unknown) const { return unknown == Unknown::displacement ? displacement_ : rotation_; }

 private:
  const Support& support_;
  const std::vector<NodalPoint>& points_;
  double factor_;
  double displacement_ = 0, rotation_ = 0;
};

}  // namespace

namespace {

using NodeFrames = std::vector<std::pair<algebra::LocalIndex, EdgeFrames>>;

/// The owned nodes on which a support acts, with the frames of its boundary (collective).
NodeFrames nodes_of(const Support& support, const fem::Space& space, const fem::Surface& surface,
                    const std::vector<NodalPoint>& points) {
  if (support.point) {
    NodeFrames nodes;
    for (const algebra::LocalIndex node : owned_nodes_at(space, points, *support.point))
      nodes.emplace_back(node, EdgeFrames{});
    if (algebra::sum_over_ranks(static_cast<std::int64_t>(nodes.size()), space.layout->comm) > 0) return nodes;
    throw SupportError(fmt::format("the point ({:.10g}, {:.10g}) of a support is no node of the mesh",
                                   (*support.point)[0], (*support.point)[1]));
  }
  const auto& names = space.coarse->boundaries;
  const auto found = std::ranges::find(names, support.boundary);
  if (found == names.end())
    throw SupportError(
        fmt::format("there is no boundary \"{}\"; the mesh has: {}", support.boundary, fmt::join(names, ", ")));
  return FramesOn(space, surface, static_cast<int>(found - names.begin())).take();
}

}  // namespace

namespace {

/// A node of a mesh in space has an address in each of its cells.
std::vector<algebra::LocalIndex> owned_nodes_at_address(const fem::Space& space, const Eigen::Vector2d& address) {
  constexpr double tolerance = 1e-9;
  const auto location = fem::locate(*space.coarse, address);
  if (!location) return {};
  const std::vector<Eigen::Vector2d> nodes = mesh::node_points(space.shape(), space.degree);
  for (std::size_t c = 0; c < space.cells.size(); ++c) {
    const auto xi = fem::local_coordinates(space.shape(), space.cells[c], *location);
    if (!xi) continue;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if ((nodes[i] - *xi).norm() <= tolerance && space.nodes(c)[i] < space.layout->owned) return {space.nodes(c)[i]};
  }
  return {};
}

}  // namespace

std::vector<algebra::LocalIndex> owned_nodes_at(const fem::Space& space, const std::vector<NodalPoint>& points,
                                                const Eigen::Vector2d& x) {
  if (space.coarse->patches) return owned_nodes_at_address(space, x);
  const double tolerance = mesh::point_tolerance(*space.coarse);
  std::vector<algebra::LocalIndex> nodes;
  for (algebra::LocalIndex i = 0; i < space.layout->owned; ++i)
    if ((points[static_cast<std::size_t>(i)].x - x).norm() <= tolerance) nodes.push_back(i);
  return nodes;
}

std::optional<Vector3d> direction_at(const Support& support, Direction direction, const geometry::Place& place) {
  switch (direction) {
    case Direction::x:
    case Direction::y:
    case Direction::z:
      return Vector3d::Unit(static_cast<int>(direction) - static_cast<int>(Direction::x));
    case Direction::axis_1:
    case Direction::axis_2:
    case Direction::axis_3:
      return support.axes.row(static_cast<int>(direction) - static_cast<int>(Direction::axis_1)).transpose();
    case Direction::given: {
      const Vector3d d(support.direction[0](place), support.direction[1](place), support.direction[2](place));
      if (d.allFinite() && !d.isZero(0)) return d.stableNormalized();
      throw SupportError(fmt::format("the direction of a support is ({:g}, {:g}, {:g}) at x = {:g}, y = {:g}", d[0],
                                     d[1], d[2], place.x, place.y));
    }
    default:
      return {};
  }
}

std::vector<NodeSupport> node_supports(const fem::Space& space, const fem::Surface& surface,
                                       const std::vector<NodalPoint>& points, const std::vector<Support>& supports,
                                       const energy::Factors& factors) {
  std::vector<NodeSupport> all(static_cast<std::size_t>(space.layout->owned));
  for (const Support& support : supports) {
    if (factors.is_released(support.factor)) continue;
    const NodeFrames frames = nodes_of(support, space, surface, points);
    Rows rows(support, points, factors.support(support.factor));
    algebra::in_agreement<SupportError>(space.layout->comm, [&] {
      for (const auto& [node, edges] : frames) rows.add(node, edges, all[static_cast<std::size_t>(node)]);
    });
    const double displacement = algebra::max_over_ranks(rows.largest(Unknown::displacement), space.layout->comm),
                 rotation = algebra::max_over_ranks(rows.largest(Unknown::rotation), space.layout->comm);
    for (const auto& [node, edges] : frames) {
      NodeSupport& at_node = all[static_cast<std::size_t>(node)];
      at_node.displacement_scale = std::max(at_node.displacement_scale, displacement);
      at_node.rotation_scale = std::max(at_node.rotation_scale, rotation);
    }
  }
  move_to_free_nodes(space, points, all);
  return all;
}

}  // namespace plastron::assembly

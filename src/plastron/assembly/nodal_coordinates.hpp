// The coordinates in which supports and contact are bounds (D4): y = T z at every node, with T and bounds from
// node_coordinates.hpp. Non-penetration is a bound of the coordinate that a contact row names. A support is lower ==
// upper. Without the coordinate r . a_3 the fields are those of V (M10).
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/assembly/node_coordinates.hpp>
#include <plastron/assembly/state.hpp>
#include <plastron/assembly/supports.hpp>
#include <plastron/element/formulation.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace plastron::assembly {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The obstacles of a shell.
struct RigidObstacles {
  std::vector<obstacle::Obstacle> all{};  ///< obstacles at the positions where their gaps are linearised
  std::vector<Vector3d> moved{};          ///< displacement of each by its force since then; empty: zero [m]
  double face_scale = 1;    ///< faces lie at this multiple of e/2; not 1 in studies that vary the stiffness alone
  bool are_linear = false;  ///< gaps are linear: (M16) at the undeformed shell, in every state

  bool empty() const { return all.empty(); }
  Vector3d way(std::size_t k) const { return moved.empty() ? Vector3d(0, 0, 0) : moved[k]; }
  /// Returns the gap (M16) against obstacle k, with the normals of the linearisation.
  obstacle::Gap gap(std::size_t k, obstacle::ShellPoint at) const {
    at.thickness *= face_scale;
    obstacle::Gap gap = obstacle::gap_at(all[k], at);
    gap.initial -= gap.normal.dot(way(k));
    return gap;
  }
  /// Returns the gap between the shell at `at` and obstacle k, whose present position is `now`. It is linearised only
  /// if the gaps are linear, as with planes.
  obstacle::FaceGap true_gap(std::size_t k, const obstacle::Obstacle& now, obstacle::ShellPoint at) const {
    if (are_linear) {
      obstacle::ShellPoint undeformed = at;
      undeformed.u = undeformed.r = Vector3d::Zero();
      const obstacle::Gap linear = gap(k, undeformed);
      const double distance = linear(at.u, at.r);
      return {.z = linear.z, .distance = distance, .normal = linear.normal, .clearance = distance};
    }
    at.thickness *= face_scale;
    return obstacle::face_gap(now, at);
  }
  /// Returns obstacle k at its present position.
  obstacle::Obstacle now(std::size_t k) const {
    obstacle::Obstacle result = all[k];
    result.placement.translation += way(k);
    return result;
  }
  /// Returns the same obstacles at their positions in the state.
  RigidObstacles standing(const State& state) const {
    RigidObstacles result{.moved = std::vector<Vector3d>(all.size(), Vector3d::Zero()),
                          .face_scale = face_scale,
                          .are_linear = are_linear};
    for (std::size_t k = 0; k < all.size(); ++k) result.all.push_back(all[k].standing(state.time, state.position(k)));
    return result;
  }
};

struct NodalCoordinates {
  int width = 5;                 ///< coordinates of a node: 6 where r . a_3 is a coordinate
  std::vector<NodeBasis> basis;  ///< T of every local node
  std::vector<char> supported;   ///< node has prescribed components (local)
  /// Values of the node follow from other nodes (local): T = 0, and its coordinates are fixed at 0.
  std::vector<char> tied;
  std::shared_ptr<const fem::Space> space{};
  algebra::Vector lower, upper;                    ///< bounds of z (block: width)
  std::vector<std::vector<obstacle::Gap>> gaps{};  ///< gaps by obstacle and local node
  std::vector<ContactRow> rows{};                  ///< rows of owned nodes, node by node, one for each obstacle

  static constexpr int normal_rotation = 5;  ///< the coordinate r . a_3

  /// Returns the rows of an owned node, one for each obstacle.
  std::span<const ContactRow> rows_of(std::size_t node) const {
    return {rows.data() + node * gaps.size(), gaps.size()};
  }
  /// Whether some contact row bounds a coordinate of the owned node.
  bool is_touchable(std::size_t node) const { return std::ranges::any_of(rows_of(node), &ContactRow::is_touchable); }
  /// Place of coordinate k of a node in z.
  std::size_t at(std::size_t node, int k) const {
    return node * static_cast<std::size_t>(width) + static_cast<std::size_t>(k);
  }
  bool is_prescribed(std::size_t node, int k) const { return lower.local()[at(node, k)] == upper.local()[at(node, k)]; }
  /// Marks the owned coordinates that are prescribed.
  std::vector<char> prescribed() const;
  /// Returns the change of the node's own (u, r) with coordinate k: the column of T. It is zero where the coordinate is
  /// a motion of a rigid body, or where the node leaves it to a body.
  Vector6 direction(std::size_t node, int k) const;
  /// Computes y = H G T z on local nodes. H are the ties, G is the matrix of carried nodes
  /// (fem/constraints.hpp). Needs z's ghosts; the result has valid ghosts.
  void to_cartesian(const algebra::Vector& z, algebra::Vector& y) const;
  /// Computes z += T' G' H' f on owned nodes. f is complete on owned nodes; afterwards f contains G' H' f (collective
  /// where there are ties or carried nodes).
  void add_transposed(algebra::Vector& f, algebra::Vector& z) const;
};

/// Returns the owned nodes at a point of Omega, up to fem::point_tolerance(): none or one. There are more where a mesh
/// file has several in one place.
std::vector<algebra::LocalIndex> owned_nodes_at(const fem::Space& space, const std::vector<NodalPoint>& points,
                                                const Eigen::Vector2d& x);

/// Returns the supports of owned nodes by local index; empty where a node has none (collective, throws SupportError).
std::vector<NodeSupport> node_supports(const fem::Space& space, const fem::Surface& surface,
                                       const std::vector<NodalPoint>& points, const std::vector<Support>& supports);

/// A matrix on the Cartesian values of a cell's nodes (six columns for each node), transformed to coordinates.
/// It has `width` columns for each node on which the cell's values depend.
struct InCoordinates {
  std::vector<algebra::LocalIndex> nodes;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix;
};
InCoordinates in_coordinates(const NodalCoordinates& coordinates, std::size_t cell,
                             const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& cartesian);

/// Returns a point of the shell after the motion (u, r) = `moved`.
obstacle::ShellPoint shell_point(const Vector3d& phi, const Vector3d& a3, double thickness, const Vector6& moved);

/// Returns the coordinates with the gaps against `obstacles` at their positions, linearised at `state` (collective).
/// Throws SupportError, ObstacleError.
NodalCoordinates nodal_coordinates(std::shared_ptr<const fem::Space> space, const fem::Surface& surface,
                                   const std::vector<NodalPoint>& points, const std::vector<Support>& supports,
                                   const RigidObstacles& obstacles, element::Formulation formulation,
                                   const State& state = {});

}  // namespace plastron::assembly

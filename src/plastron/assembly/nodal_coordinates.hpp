// The coordinates in which supports and contact are bounds (D4): y = C T z. T has one basis for each node, with bounds
// from node_coordinates.hpp, and C are the constraints between nodes (fem/constraints.hpp). Non-penetration is a bound of
// the coordinate that a contact row names. A support is lower == upper. Without the coordinate r . a_3 the fields are
// those of V (M10).
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/assembly/description.hpp>
#include <plastron/assembly/node_coordinates.hpp>
#include <plastron/assembly/state.hpp>
#include <plastron/constraints/map.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace plastron::assembly {

using RowMatrix = constraints::RowMatrix;

/// Gaps of this part of the thickness are rounding: the distance to an obstacle that is much larger than the shell has few digits.
inline constexpr double gap_rounding = 1e-9;

struct NodalCoordinates {
  int width = 5;                 ///< coordinates of a node: 6 where r . a_3, or the surface of a bed, is a coordinate
  std::vector<NodeBasis> basis;  ///< T of every local node
  std::shared_ptr<const fem::Space> space{};
  algebra::Vector lower, upper;                    ///< bounds of z (block: width)
  std::vector<std::vector<obstacle::Gap>> gaps{};  ///< gaps by obstacle and local node
  /// 0 at nodes of a fold where another side is nearer to the obstacle, else 1 (block: obstacles); without layout where
  /// there are no folds.
  algebra::Vector nearest_faces{};
  std::vector<ContactRow> rows{};  ///< rows of owned nodes, node by node, one for each obstacle

  static constexpr int normal_rotation = 5;  ///< the coordinate r . a_3

  /// Returns the rows of an owned node, one for each obstacle.
  std::span<const ContactRow> rows_of(std::size_t node) const {
    return {rows.data() + node * gaps.size(), gaps.size()};
  }
  /// Whether some contact row bounds a coordinate of the owned node.
  bool is_touchable(std::size_t node) const { return std::ranges::any_of(rows_of(node), &ContactRow::is_touchable); }
  /// Whether the supports fix the row's face inside its obstacle, where no bound can move it out. `point` is the row's
  /// node. The limit is the rounding of the gap's terms, for any unit of length.
  bool is_fixed_inside(const ContactRow& row, const NodalPoint& point) const;
  /// Place of coordinate k of a node in z.
  std::size_t at(std::size_t node, int k) const {
    return node * static_cast<std::size_t>(width) + static_cast<std::size_t>(k);
  }
  bool is_prescribed(std::size_t node, int k) const { return lower.local()[at(node, k)] == upper.local()[at(node, k)]; }
  /// Marks the owned coordinates that are prescribed.
  std::vector<char> prescribed() const;
  /// Returns the change of the node's own (u, r) with coordinate k: the column of T, without what the node leaves to
  /// others. It is zero where the coordinate is a motion of a rigid body.
  Vector6 direction(std::size_t node, int k) const;
  /// Computes y = C T z on local nodes. Needs z's ghosts; the result has valid ghosts.
  void to_cartesian(const algebra::Vector& z, algebra::Vector& y) const;
  /// Adds the forces of the springs of beds at coordinates z to `forces`, both on owned nodes.
  void add_bed_forces(const algebra::Vector& z, algebra::Vector& forces) const;
  /// Adds their stiffness to a matrix in these coordinates that is not finished.
  void add_bed_stiffness(algebra::Matrix& matrix) const;
  /// Computes z += T' C' f on owned nodes. f is complete on owned nodes; afterwards f contains C' f (collective where
  /// there are constraints).
  void add_transposed(algebra::Vector& f, algebra::Vector& z) const;
};

/// Returns the owned nodes at a point of Omega, up to mesh::point_tolerance(): none or one. There are more where a mesh
/// file has several in one place.
std::vector<algebra::LocalIndex> owned_nodes_at(const fem::Space& space, const std::vector<NodalPoint>& points,
                                                const Eigen::Vector2d& x);

/// Returns the supports of owned nodes by local index, with values times their factors; empty where a node has none. Supports of
/// constrained nodes are given to the nodes that these follow from (collective, throws SupportError).
std::vector<NodeSupport> node_supports(const fem::Space& space, const fem::Surface& surface,
                                       const std::vector<NodalPoint>& points, const std::vector<Support>& supports,
                                       const energy::Factors& factors = {});

/// Transforms a matrix on the Cartesian values of nodes, six columns for each, to coordinates. The result has `width` columns for
/// each node on which their values depend.
constraints::NodeColumns in_coordinates(const NodalCoordinates& coordinates, std::span<const algebra::LocalIndex> nodes,
                                        RowMatrix cartesian);

/// Transforms a symmetric matrix on (u, r) of nodes to coordinates, on both sides.
constraints::NodeColumns on_both_sides(const NodalCoordinates& coordinates, std::span<const algebra::LocalIndex> nodes,
                                       RowMatrix matrix);

/// Returns a point of the shell after the motion (u, r) = `moved` with small rotations.
obstacle::ShellPoint shell_point(const Vector3d& phi, const Vector3d& a3, double thickness, const Vector6& moved);

/// Returns the coordinates with the gaps against `obstacles` at their positions, linearised at `state`. `supports`: those
/// of node_supports() (collective). Throws SupportError, ObstacleError.
NodalCoordinates nodal_coordinates(std::shared_ptr<const fem::Space> space, const std::vector<NodalPoint>& points,
                                   const std::vector<NodeSupport>& supports, const RigidObstacles& obstacles,
                                   element::Formulation formulation, const State& state = {});

}  // namespace plastron::assembly

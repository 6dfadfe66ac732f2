// Nodal coordinates in which contact is a bound (D4).
//
// At every node the six Cartesian values y = (u, r) are written as y = T z with five coordinates z, or six:
//   z_0          w = n . (u + z r), the change of the gap, where the node can touch the obstacle and supports leave w
//                free
//   then         displacements across n, rotations in the tangent plane
//   last         the components that supports prescribe
//   z_5          r . a_3, only in the relaxed formulations (M13, M14); it leaves w alone, so that the gap feels the
//                tangential part of r and the penalty is no compliant layer between shell and obstacle. Zero where a
//                support prescribes any component of r.
// Non-penetration is then z_0 >= -(initial gap), and a support is lower == upper.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/assembly/supports.hpp>
#include <plastron/element/formulation.hpp>
#include <plastron/obstacle/gap.hpp>

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace plastron::assembly {

/// T. Its last column, (0, a_3), counts only where the width is six.
using NodeBasis = Eigen::Matrix<double, 6, 6>;

/// The gap of (M16) at a point with mid-surface position phi, normal a_3 and thickness e.
using GapFunction = std::function<obstacle::Gap(const Vector3d& phi, const Vector3d& a3, double thickness)>;

/// Supports that contradict each other or name a boundary or a node that is not there.
struct SupportError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct NodalCoordinates {
  int width = 5;                 ///< coordinates of a node: 6 where r . a_3 is one of them
  std::vector<NodeBasis> basis;  ///< T of every local node
  std::vector<char> supported;   ///< node has prescribed components (local)
  std::vector<char> touchable;   ///< node has a contact bound on z_0 (local)
  /// gap at z_0 = 0, prescribed values included (local) [m]; NaN without obstacle, or where the nodal weight is 0
  std::vector<double> bound_gap;
  algebra::Vector lower, upper;     ///< bounds of z (block: width)
  std::vector<obstacle::Gap> gaps;  ///< per local node; empty without obstacle

  /// Place of coordinate k of a node in z.
  std::size_t at(std::size_t node, int k) const {
    return node * static_cast<std::size_t>(width) + static_cast<std::size_t>(k);
  }
  bool is_prescribed(std::size_t node, int k) const { return lower.local()[at(node, k)] == upper.local()[at(node, k)]; }
  /// y = T z on local nodes; needs z's ghosts. The result has valid ghosts.
  void to_cartesian(const algebra::Vector& z, algebra::Vector& y) const;
  /// z += T' f on owned nodes.
  void add_transposed(const algebra::Vector& f, algebra::Vector& z) const;
};

/// Rows of one node's supports: the directions in which u and r are prescribed, and the values.
struct NodeSupport {
  std::vector<std::pair<Vector3d, double>> displacement, rotation;
  /// The largest values that these supports prescribe anywhere on their boundaries: what values are small against.
  double displacement_scale = 0, rotation_scale = 0;
};
/// The owned nodes at a point of Omega, up to fem::point_tolerance(): none or one, more where a mesh file has several in one place.
std::vector<algebra::LocalIndex> owned_nodes_at(const fem::Space& space, const std::vector<NodalPoint>& points,
                                                const Eigen::Vector2d& x);

/// Supports of owned nodes by local index; empty where there are none (collective, throws SupportError).
std::vector<NodeSupport> node_supports(const fem::Space& space, const fem::Surface& surface,
                                       const std::vector<NodalPoint>& points, const std::vector<Support>& supports);

/// (collective) Throws SupportError.
NodalCoordinates nodal_coordinates(const fem::Space& space, const fem::Surface& surface,
                                   const std::vector<NodalPoint>& points, const std::vector<Support>& supports,
                                   const GapFunction& gap, element::Formulation formulation);

}  // namespace plastron::assembly

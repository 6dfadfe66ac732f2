// One node's basis T (D4): which combinations of (u, r) are its coordinates, so that supports and contact rows are bounds.
//
//   first   a coordinate for each independent contact row: the change of a gap, n . (u + z r). A row parallel to another one
//           bounds the same coordinate, from the other side if it points the other way.
//   then    displacements that leave these gaps alone, rotations in the tangent plane
//   then    the components that supports prescribe
//   last    r . a_3, which leaves the gaps alone
#pragma once
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/obstacle/gap.hpp>

#include <array>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace plastron::assembly {

/// T. Its last column, (0, a_3), counts only where the width is six.
using NodeBasis = Eigen::Matrix<double, 6, 6>;

/// Supports that contradict each other or name a boundary that is not there.
struct SupportError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Rows of one node's supports: the directions in which u and r are prescribed, and the values.
struct NodeSupport {
  std::vector<std::pair<Vector3d, double>> displacement, rotation;
  /// The largest values that these supports prescribe anywhere on their boundaries: what values are small against.
  double displacement_scale = 0, rotation_scale = 0;
};

/// One obstacle against a node: gap - lift = bound_gap + scale z_coordinate, and that is not negative.
struct ContactRow {
  std::size_t node = 0;
  int obstacle = 0;
  int coordinate = -1;  ///< -1: supports leave this gap no freedom, or the node's weight is 0
  double scale = 1;     ///< negative where the row bounds its coordinate from above
  /// gap - lift at z_coordinate = 0, prescribed values included; NaN where the nodal weight is 0 [m]
  double bound_gap = 0;
  bool is_left_out = false;  ///< it depends on several gaps that are nearer and bounds nothing
  bool binds = false;        ///< the tightest on its side of its coordinate: the only one that can be in contact

  bool is_touchable() const { return coordinate >= 0; }
};

struct NodeCoordinates {
  NodeBasis basis = NodeBasis::Zero();
  std::array<double, 6> lower{}, upper{};
  std::vector<ContactRow> rows{};  ///< one for each gap, `node` not set
};

/// `gaps`: one for each obstacle, `lifts`: what they must not fall below where supports leave them free, `at`: (u, r) of the state,
/// where the nearest obstacles matter most, `size`: of the shell [m]. Throws SupportError.
NodeCoordinates node_coordinates(const NodalPoint& point, const NodeSupport& support,
                                 std::span<const obstacle::Gap> gaps, std::span<const double> lifts,
                                 const Eigen::Matrix<double, 6, 1>& at, double size);

}  // namespace plastron::assembly

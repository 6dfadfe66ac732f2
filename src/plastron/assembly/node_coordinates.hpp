// One node's basis T (D4): its coordinates are combinations of (u, r), chosen so that supports and contact rows are
// bounds.
//
//   first   a coordinate for each independent contact row: the change of a gap, n . (u + z r). A row parallel to an
//           earlier one bounds the same coordinate, from the other side if it points the other way. A row of the other
//           face that is nearly opposite to an earlier one bounds it approximately.
//   then    displacements that do not change these gaps, rotations in the tangent plane
//   then    the components that supports prescribe
//   last    r . a_3, which does not change the gaps
#pragma once
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/obstacle/gap.hpp>

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace plastron::assembly {

/// The basis T. Its last column, (0, a_3), is used only where the width is six.
using NodeBasis = Eigen::Matrix<double, 6, 6>;

/// Error of supports that contradict each other or name a boundary that does not exist.
struct SupportError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Rows of one node's supports: the directions in which u and r are prescribed, and the values.
struct NodeSupport {
  std::vector<std::pair<Vector3d, double>> displacement, rotation;
  /// The largest values that these supports prescribe anywhere on their boundaries; other values are compared with
  /// them.
  double displacement_scale = 0, rotation_scale = 0;
};

/// Contact condition between a node and one obstacle: gap - lift = bound_gap + scale z_coordinate must not be negative.
struct ContactRow {
  std::size_t node = 0;
  int obstacle = 0;
  int coordinate = -1;  ///< -1: supports leave this gap no freedom, or the node's weight is 0
  double scale = 1;     ///< negative where the row bounds its coordinate from above
  /// gap - lift at z_coordinate = 0, prescribed values included; NaN where the nodal weight is 0 [m]
  double bound_gap = 0;
  bool is_left_out = false;     ///< the gap depends on several nearer gaps and bounds nothing
  bool binds = false;           ///< the tightest row on its side of its coordinate: only this row can be in contact
  bool is_approximate = false;  ///< the bound is exact only where the other coordinates are those of the state
  /// On a bed, `coordinate` is the place of the bed's surface: tau with gap + s - shift = bound_gap + tau and the spring energy 1/2 bed s^2,
  /// s = tau - gap_scale z_gap_coordinate: the closure of the bed (M33), less the shift of its segment. `bed`: the stiffness of the
  /// segment times the node's area, 0 on a rigid obstacle [N/m].
  double bed = 0;
  obstacle::Bed::Segment segment{};
  int gap_coordinate = -1;
  double gap_scale = 1;

  bool is_touchable() const { return coordinate >= 0; }
};

struct NodeCoordinates {
  NodeBasis basis = NodeBasis::Zero();
  std::array<double, 6> lower{}, upper{};
  std::vector<ContactRow> rows{};  ///< one for each gap, `node` not set
};

/// Returns the coordinates of a node. `gaps`: one for each obstacle. `lifts`: lower limits of the gaps where supports
/// leave them free. `at`: (u, r) of the state, by which the nearest obstacles are chosen. `size`: size of the shell
/// [m]. Throws SupportError.
NodeCoordinates node_coordinates(const NodalPoint& point, const NodeSupport& support,
                                 std::span<const obstacle::Gap> gaps, std::span<const double> lifts,
                                 const Eigen::Matrix<double, 6, 1>& at, double size);

/// Gives the last coordinate, which is then not r . a_3, to the surface of the bed of an obstacle, on this segment of its law; without
/// an obstacle, or where its gap has no freedom, that coordinate is 0.
void put_on_bed(std::optional<std::size_t> obstacle, const obstacle::Bed::Segment& segment, const NodalPoint& point,
                NodeCoordinates& node);

}  // namespace plastron::assembly

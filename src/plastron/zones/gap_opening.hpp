// The edge of a contact zone, found from the gaps of free nodes.
//
// Outside next to the edge, the shear force Q is about constant. The moment is M = Q (s + delta) at the distance s
// from the edge. Inside, rotations decay like exp(-|s|/delta), delta^2 = D/G = e^2/(6 (1 - nu) k_s) the ratio of
// bending to shear stiffness (shell::bending_length), and M is continuous. Therefore the gap opens like
//
//     g = c s^2 (3 delta + s),
//
// a parabola in thick shells and a cubic in thin ones. Solved for s, the gaps at free nodes are distances that vary
// smoothly; curvature, loads and the shell's slope change them a little. A polynomial of degree 2 is fitted to them
// in the tangent plane; c is such that it has slope 1 at its zero. Touching nodes do not enter the fit: the outermost
// ones often lie outside of the true zone, by less than half the distance of nodes.
#pragma once
#include <plastron/zones/sub_cells.hpp>
#include <plastron/zones/touching_nodes.hpp>

#include <optional>

namespace plastron::zones {

/// A search for the edge near a point.
struct EdgeSearch {
  Vector3d from;                           ///< a point near the edge, on the mid-surface
  Eigen::Matrix<double, 3, 2> axes;        ///< orthonormal axes of the tangent plane at the point
  double shear_length = 0;                 ///< delta, see shell::bending_length() [m]
  Vector3d inwards;                        ///< direction from a free node beside the point to a touching one
  std::optional<Eigen::Vector2d> along{};  ///< the only admissible direction of the way, in the axes; set on a border
};

class GapOpening {
 public:
  /// Collects the free nodes next to the zones of one obstacle (collective).
  GapOpening(const assembly::DiscreteShell& discrete, const TouchingNodes& touching);

  /// Returns the way from `from` to the edge. The free nodes connected with the local node `free` predict the edge.
  /// Empty if they are too few or their fit is not trusted.
  std::optional<Vector3d> way_to_edge(algebra::LocalIndex free, const EdgeSearch& search) const;

 private:
  struct FreeNode {
    Vector3d place;
    double gap;
  };

  ZoneLabels parts_;                            // components of the free nodes: some lie inside of a zone
  std::vector<std::vector<FreeNode>> nodes_{};  // free nodes next to zones, by component, of all ranks
};

}  // namespace plastron::zones

// Where the edge of a contact zone lies, as the gap outside tells.
//
// Next to the edge, outside, the shear force Q is about constant and the moment is M = Q (s + delta), s the distance from the edge:
// inside, rotations fade like exp(-|s|/delta), delta^2 = D/G = e^2/(6 (1 - nu) k_s) the bending over the shear stiffness, and M is
// continuous. So the gap opens like
//
//     g = c s^2 (3 delta + s),
//
// a parabola in thick shells and a cube in thin ones. Solved for s, gaps at free nodes are distances that vary smoothly (curvature,
// loads and the shell's slope bend them a little): a polynomial of degree 2 is fitted to them in the tangent plane, with c such that it
// has slope 1 where it is zero. Nodes that touch have no say: the outermost ones often lie outside of the true zone, by less than half
// the distance of nodes.
#pragma once
#include <plastron/certificate/touching_nodes.hpp>
#include <plastron/certificate/zone_labels.hpp>

#include <optional>

namespace plastron::certificate {

/// delta of the material in a shell of this thickness [m].
double shear_length(const shell::Material& material, double thickness);

/// Where to look for the edge.
struct EdgeSearch {
  Vector3d from;                           ///< a point near the edge, on the mid-surface
  Eigen::Matrix<double, 3, 2> axes;        ///< orthonormal, of the tangent plane there
  double shear_length = 0;                 ///< delta [m]
  Vector3d inwards;                        ///< from a free node beside it to a touching one
  std::optional<Eigen::Vector2d> along{};  ///< the only direction that the way may have, in the axes: on a border
};

class GapOpening {
 public:
  /// Of the nodes next to the zones of one obstacle (collective).
  GapOpening(const assembly::DiscreteShell& discrete, const TouchingNodes& touching);

  /// From `from` to the edge, as free nodes see it that are connected with this local one; nothing if these are few or tell nothing.
  std::optional<Vector3d> way_to_edge(algebra::LocalIndex free, const EdgeSearch& search) const;

 private:
  struct FreeNode {
    Vector3d place;
    double gap;
  };

  ZoneLabels parts_;                            // of the free nodes: some lift off inside of a zone
  std::vector<std::vector<FreeNode>> nodes_{};  // next to zones, by part, of all ranks
};

}  // namespace plastron::certificate

// Supports of nodes that a kink carries (fem/constraints.hpp): their rows on u and on the rotation about the edge go to the
// other node.
#pragma once
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/assembly/node_coordinates.hpp>

namespace plastron::assembly {

/// Moves rows of owned kinked nodes to the nodes that they concern, on any rank. Call it after hand_to_masters()
/// (collective). Throws SupportError where a support prescribes one combination of both rotations, or a rotation at a
/// corner where several kinks meet.
void hand_across_kinks(const fem::Space& space, const std::vector<NodalPoint>& points,
                       std::vector<NodeSupport>& supports);

}  // namespace plastron::assembly

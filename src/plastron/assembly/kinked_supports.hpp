// Supports of nodes that a kink carries (fem/kinks.hpp): what they say of u and of the rotation about the edge is said of the other node.
#pragma once
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/assembly/node_coordinates.hpp>

namespace plastron::assembly {

/// Moves the rows of owned kinked nodes that concern others to those, wherever they are owned; after hand_to_masters() (collective). Throws
/// SupportError where a support prescribes one combination of both rotations, or a rotation at a corner where several kinks meet.
void hand_across_kinks(const fem::Space& space, const std::vector<NodalPoint>& points,
                       std::vector<NodeSupport>& supports);

}  // namespace plastron::assembly

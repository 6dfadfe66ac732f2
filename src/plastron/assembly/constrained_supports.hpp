// Supports of constrained nodes. A node on a joined edge gives its rows to the node that it equals. A node at a kink
// gives its rows on u, and on the rotation about the edge, to the node that determines them.
#pragma once
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/assembly/node_coordinates.hpp>

#include <vector>

namespace plastron::assembly {

/// Moves the rows of owned nodes to the nodes that they concern, on any rank (collective). A node that hangs between
/// several masters only loses its rows: the masters are on the same boundary. Throws SupportError where a support
/// prescribes one combination of the two rotations at a kink, or a rotation at a corner where several kinks meet.
void move_to_free_nodes(const fem::Space& space, const std::vector<NodalPoint>& points,
                        std::vector<NodeSupport>& supports);

}  // namespace plastron::assembly

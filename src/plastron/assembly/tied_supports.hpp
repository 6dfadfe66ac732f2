// Supports of nodes that are tied to another one: that other node is held in their stead.
#pragma once
#include <plastron/assembly/node_coordinates.hpp>
#include <plastron/fem/space.hpp>

namespace plastron::assembly {

/// Adds the rows of each owned node that is the same as another one to those of its master, wherever that is owned, and takes them
/// from the tied node (collective). Nodes that hang between several masters just lose theirs: the masters are on the same boundary.
void hand_to_masters(const fem::Space& space, std::vector<NodeSupport>& supports);

}  // namespace plastron::assembly

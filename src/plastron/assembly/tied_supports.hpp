// Supports of nodes that are tied to another node: the other node is fixed instead.
#pragma once
#include <plastron/assembly/node_coordinates.hpp>
#include <plastron/fem/space.hpp>

namespace plastron::assembly {

/// Moves the rows of each owned node that is tied to one equal node to this master, on any rank (collective).
/// Nodes that hang between several masters only lose their rows: the masters are on the same boundary.
void hand_to_masters(const fem::Space& space, std::vector<NodeSupport>& supports);

}  // namespace plastron::assembly

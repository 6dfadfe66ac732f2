// Hanging nodes on the side of a larger cell: their values are interpolated from that side's nodes, so that fields
// are continuous. The mesh gives these relations one step at a time, each rank for its own nodes. Here they become
// ties of all local nodes to free nodes.
#pragma once
#include <plastron/fem/space.hpp>

#include <utility>
#include <vector>

namespace plastron::fem {

/// A hanging node with its masters, which may hang too, on the side of a still larger cell.
struct HangingNode {
  algebra::GlobalIndex node = 0;
  std::vector<std::pair<algebra::GlobalIndex, double>> masters{};  ///< at most degree + 1
};

/// Ties the hanging nodes of a space that has no ties yet (collective). `owned`: all hanging nodes that this rank
/// owns. Adds missing masters to the layout as ghosts.
void tie_hanging_nodes(Space& space, const std::vector<HangingNode>& owned);

}  // namespace plastron::fem

// Nodes that hang on the side of a larger cell: interpolations of that side's nodes, so that fields are continuous. A mesh knows them one
// step at a time, each rank for its own nodes; here they become ties of all local nodes to nodes that are free.
#pragma once
#include <plastron/fem/space.hpp>

#include <utility>
#include <vector>

namespace plastron::fem {

/// A node and what it interpolates; these may hang, too, on a side that is larger still.
struct HangingNode {
  algebra::GlobalIndex node = 0;
  std::vector<std::pair<algebra::GlobalIndex, double>> masters{};  ///< degree + 1 at most
};

/// Ties the hanging nodes of a space that has no ties yet. `owned`: all that this rank owns. The layout gets the masters as ghosts that it
/// lacks (collective).
void tie_hanging_nodes(Space& space, const std::vector<HangingNode>& owned);

}  // namespace plastron::fem

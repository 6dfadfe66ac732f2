// Which nodes in contact belong together: connected components over the sub-cells of the mesh, across ranks and joined edges.
#pragma once
#include <plastron/certificate/touching_nodes.hpp>

#include <vector>

namespace plastron::certificate {

struct ZoneLabels {
  int count = 0;
  std::vector<int>
      of_node{};  ///< of local nodes that touch: 0 to count - 1, the same on every rank that sees the node; else -1
};

/// (collective)
ZoneLabels zone_labels(const fem::Space& space, const TouchingNodes& touching);

}  // namespace plastron::certificate

// Connected components of the nodes that touch, or of the nodes that do not, over the sub-cells of the mesh, across
// ranks and joined edges.
#pragma once
#include <plastron/fem/space.hpp>

#include <span>
#include <vector>

namespace plastron::zones {

struct ZoneLabels {
  int count = 0;
  /// Label of local nodes inside: 0 to count - 1, the same on every rank that has the node; -1 for other nodes.
  std::vector<int> of_node{};
};

/// Labels the local nodes for which `inside` is 1 (collective).
ZoneLabels zone_labels(const fem::Space& space, std::span<const char> inside);

}  // namespace plastron::zones

// Which of the nodes that touch, or of those that do not, belong together: connected components over the sub-cells of the mesh, across ranks and joined edges.
#pragma once
#include <plastron/fem/space.hpp>

#include <span>
#include <vector>

namespace plastron::certificate {

struct ZoneLabels {
  int count = 0;
  /// Of local nodes inside: 0 to count - 1, the same on every rank that sees the node; else -1.
  std::vector<int> of_node{};
};

/// `inside` is 1 or 0 of each local node (collective).
ZoneLabels zone_labels(const fem::Space& space, std::span<const char> inside);

}  // namespace plastron::certificate

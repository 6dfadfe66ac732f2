// Sub-cells: a cell of degree k is divided into k^2 sub-cells with nodes at their corners. Each side is shared with a
// neighbour. Nodes are neighbours if they are corners of one sub-cell. Zones are connected components of neighbours.
#pragma once
#include <plastron/fem/space.hpp>
#include <plastron/mesh/reference_cell.hpp>

#include <array>
#include <span>
#include <vector>

namespace plastron::zones {

/// Three or four nodes of the cell in their order round a sub-cell.
using SubCell = std::vector<int>;

std::vector<SubCell> sub_cells(mesh::Shape shape, int degree);

/// Calls visit(a, b) for every two corners of all sub-cells of owned cells, in both orders.
template <class Visit>
void for_neighbours(const fem::Space& space, Visit&& visit) {
  const auto subs = sub_cells(space.shape(), space.degree);
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const auto nodes = space.nodes(c);
    for (const SubCell& sub : subs)
      for (std::size_t i = 0; i < sub.size(); ++i)
        for (std::size_t j = 0; j < sub.size(); ++j)
          if (i != j) visit(nodes[static_cast<std::size_t>(sub[i])], nodes[static_cast<std::size_t>(sub[j])]);
  }
}

/// Adds the sums of each rank's own cells over all ranks at every local node (collective).
inline void make_whole(const fem::Space& space, algebra::Vector& sums) {
  sums.accumulate_ghosts();
  space.continuity.apply_transposed(sums);
  sums.update_ghosts();
  space.continuity.apply(sums);
}

/// Connected components of the nodes that touch, or of the nodes that do not, across ranks and joined edges.
struct ZoneLabels {
  int count = 0;
  /// Label of local nodes inside: 0 to count - 1, the same on every rank that has the node; -1 for other nodes.
  std::vector<int> of_node{};
};

/// Labels the local nodes for which `inside` is 1 (collective).
ZoneLabels zone_labels(const fem::Space& space, std::span<const char> inside);

}  // namespace plastron::zones

// Neighbours, nodes that are corners of one sub-cell, and sums over them.
#pragma once
#include <plastron/fem/constraints.hpp>
#include <plastron/zones/sub_cells.hpp>

namespace plastron::zones {

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
  fem::collect(space, sums);
  sums.update_ghosts();
  fem::spread(space, sums);
}

}  // namespace plastron::zones

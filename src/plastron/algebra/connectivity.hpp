// The nodes of elements.
#pragma once
#include <plastron/algebra/layout.hpp>

#include <span>
#include <vector>

namespace plastron::algebra {

/// The node lists of elements (local node indices), element by element.
struct Connectivity {
  int nodes_per_element = 0;  ///< unless `start` gives other numbers
  std::vector<LocalIndex> nodes{};
  std::vector<std::size_t>
      start{};  ///< first entry of each element, then the end; empty if all elements have the same number of nodes
  std::size_t elements() const {
    if (!start.empty()) return start.size() - 1;
    return nodes_per_element ? nodes.size() / static_cast<std::size_t>(nodes_per_element) : 0;
  }
  std::span<const LocalIndex> element(std::size_t e) const {
    if (!start.empty()) return {nodes.data() + start[e], start[e + 1] - start[e]};
    return {nodes.data() + e * static_cast<std::size_t>(nodes_per_element),
            static_cast<std::size_t>(nodes_per_element)};
  }
};

}  // namespace plastron::algebra

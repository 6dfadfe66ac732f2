#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/distribution.hpp>

#include <algorithm>
#include <utility>

namespace plastron::algebra {

bool Distribution::sees(GlobalIndex node) const { return owns(node) || std::ranges::binary_search(ghosts, node); }

LocalIndex Distribution::local(GlobalIndex node) const {
  PLASTRON_ASSERT(sees(node), node, first, owned, ghosts.size());
  if (owns(node)) return static_cast<LocalIndex>(node - first);
  return owned + static_cast<LocalIndex>(std::ranges::lower_bound(ghosts, node) - ghosts.begin());
}

void Distribution::add_ghosts(std::vector<GlobalIndex> nodes) {
  std::erase_if(nodes, [&](GlobalIndex node) { return owns(node); });
  nodes.insert(nodes.end(), ghosts.begin(), ghosts.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  ghosts = std::move(nodes);
}

}  // namespace plastron::algebra

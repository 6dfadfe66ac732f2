// Hanging nodes on the side of a larger cell: their values are interpolated from that side's nodes, so that fields
// are continuous. The mesh gives these relations one step at a time, each rank for its own nodes. Here they become
// rows of all local nodes on free nodes.
#include <plastron/algebra/vector.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/fem/boundary_nodes.hpp>
#include <plastron/fem/constraints.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace plastron::fem {

namespace {

using algebra::GlobalIndex, algebra::LocalIndex;
using Masters = std::map<GlobalIndex, double>;

/// Weights are of order one; smaller ones than this are zero.
constexpr double no_weight = 1e-13;

/// Masters of the local nodes, from the nodes' owners. Free nodes have no entry (collective).
class OneStep {
 public:
  OneStep(const Space& space, const std::vector<HangingNode>& owned) {
    // The number of masters, then their numbers and weights.
    algebra::Vector packed(space.layout, 1 + 2 * (space.degree + 1));
    const auto block = static_cast<std::size_t>(packed.block());
    for (const HangingNode& hanging : owned) {
      double* at = packed.local().data() + static_cast<std::size_t>(hanging.node - space.layout->first) * block;
      *at++ = static_cast<double>(hanging.masters.size());
      for (const auto& [master, weight] : hanging.masters) {
        *at++ = static_cast<double>(master);
        *at++ = weight;
      }
    }
    packed.update_ghosts();
    for (LocalIndex i = 0; i < space.layout->local_size(); ++i) {
      const double* at = packed.local().data() + static_cast<std::size_t>(i) * block;
      if (*at == 0) continue;
      Masters& masters = of_node_[space.layout->global(i)];
      for (int k = 0; k < static_cast<int>(at[0]); ++k)
        masters[static_cast<GlobalIndex>(at[1 + 2 * k])] += at[2 + 2 * k];
    }
  }

  const std::map<GlobalIndex, Masters>& all() const { return of_node_; }

  /// Returns the free nodes on which a node depends.
  Masters resolved(GlobalIndex node) const {
    Masters free, open{{node, 1.0}};
    while (!open.empty()) {
      const auto [next, factor] = *open.begin();
      open.erase(open.begin());
      const auto found = of_node_.find(next);
      if (found == of_node_.end())
        free[next] += factor;
      else
        for (const auto& [master, weight] : found->second) open[master] += factor * weight;
    }
    std::erase_if(free, [](const auto& entry) { return std::abs(entry.second) < no_weight; });
    return free;
  }

 private:
  std::map<GlobalIndex, Masters> of_node_{};
};

/// Masters that are not in this rank's layout.
std::set<GlobalIndex> unseen(const algebra::Layout& layout, const OneStep& hanging) {
  std::set<GlobalIndex> nodes;
  for (const auto& [node, masters] : hanging.all())
    for (const auto& [master, weight] : masters)
      if (!layout.sees(master)) nodes.insert(master);
  return nodes;
}

}  // namespace

void constrain_hanging_nodes(Space& space, const std::vector<HangingNode>& owned) {
  const MPI_Comm comm = space.layout->comm;
  if (algebra::sum_over_ranks(static_cast<std::int64_t>(owned.size()), comm) == 0) return;
  OneStep hanging(space, owned);
  // A master may hang itself, on masters that only its owner has.
  for (auto missing = unseen(*space.layout, hanging);
       algebra::sum_over_ranks(static_cast<std::int64_t>(missing.size()), comm) > 0;
       missing = unseen(*space.layout, hanging)) {
    widen(space, missing);
    hanging = OneStep(space, owned);
  }
  const algebra::Layout& layout = *space.layout;
  std::vector<constraints::Row> rows;
  for (LocalIndex i = 0; i < layout.local_size(); ++i) {
    const GlobalIndex node = layout.global(i);
    if (!hanging.all().contains(node)) continue;
    constraints::Row& row = rows.emplace_back(constraints::Row{.node = i});
    for (const auto& [master, weight] : hanging.resolved(node))
      row.terms.push_back({.node = layout.local(master), .weight = weight});
  }
  space.continuity = constraints::Map(std::move(rows), comm);
  space.constraints = space.continuity;
}

}  // namespace plastron::fem

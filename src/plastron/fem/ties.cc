#include <plastron/fem/ties.hpp>

#include <algorithm>

namespace plastron::fem {

namespace {

const Tie* tie_of(const Space& space, algebra::LocalIndex node) {
  const auto found = std::ranges::lower_bound(space.ties, node, {}, &Tie::node);
  return found != space.ties.end() && found->node == node ? &*found : nullptr;
}

std::size_t index_of(algebra::LocalIndex node, std::vector<algebra::LocalIndex>& nodes) {
  const auto found = std::ranges::find(nodes, node);
  if (found != nodes.end()) return static_cast<std::size_t>(found - nodes.begin());
  nodes.push_back(node);
  return nodes.size() - 1;
}

}  // namespace

void spread(const Space& space, algebra::Vector& v) {
  const auto block = static_cast<std::size_t>(v.block());
  const auto values = v.local();
  for (const Tie& tie : space.ties)
    for (std::size_t c = 0; c < block; ++c) {
      double sum = 0;
      for (const auto& [master, weight] : tie.masters)
        sum += weight * values[static_cast<std::size_t>(master) * block + c];
      values[static_cast<std::size_t>(tie.node) * block + c] = sum;
    }
}

void collect(const Space& space, algebra::Vector& f) {
  if (!space.has_ties) return;
  const auto block = static_cast<std::size_t>(f.block());
  const auto values = f.local();
  std::ranges::fill(values.subspan(f.owned().size()), 0.0);
  for (const Tie& tie : space.ties) {
    if (tie.node >= space.layout->owned) continue;
    for (std::size_t c = 0; c < block; ++c) {
      double& own = values[static_cast<std::size_t>(tie.node) * block + c];
      for (const auto& [master, weight] : tie.masters)
        values[static_cast<std::size_t>(master) * block + c] += weight * own;
      own = 0;
    }
  }
  f.accumulate_ghosts();
}

std::optional<Carriers> carriers(const Space& space, std::size_t cell) {
  if (space.ties.empty()) return {};
  const auto nodes = space.nodes(cell);
  if (std::ranges::none_of(nodes, [&](algebra::LocalIndex node) { return tie_of(space, node) != nullptr; })) return {};
  Carriers result;
  std::vector<std::pair<std::size_t, std::pair<std::size_t, double>>> entries;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (const Tie* tie = tie_of(space, nodes[i]))
      for (const auto& [master, weight] : tie->masters)
        entries.push_back({i, {index_of(master, result.nodes), weight}});
    else
      entries.push_back({i, {index_of(nodes[i], result.nodes), 1.0}});
  }
  result.weights =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(nodes.size()), static_cast<Eigen::Index>(result.nodes.size()));
  for (const auto& [i, entry] : entries)
    result.weights(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(entry.first)) += entry.second;
  return result;
}

algebra::Connectivity coupled_nodes(const Space& space) {
  if (space.ties.empty()) return space.connectivity;
  algebra::Connectivity coupled{.nodes_per_element = 0, .nodes = {}, .start = {0}};
  for (std::size_t cell = 0; cell < space.cells.size(); ++cell) {
    const auto of_cell = carriers(space, cell);
    const std::span<const algebra::LocalIndex> nodes = of_cell ? std::span(of_cell->nodes) : space.nodes(cell);
    coupled.nodes.insert(coupled.nodes.end(), nodes.begin(), nodes.end());
    coupled.start.push_back(coupled.nodes.size());
  }
  return coupled;
}

}  // namespace plastron::fem

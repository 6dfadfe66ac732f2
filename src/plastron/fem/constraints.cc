#include <plastron/fem/constraints.hpp>

#include <algorithm>

namespace plastron::fem {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using algebra::LocalIndex;

const Tie* tie_of(const Space& space, LocalIndex node) {
  const auto found = std::ranges::lower_bound(space.ties, node, {}, &Tie::node);
  return found != space.ties.end() && found->node == node ? &*found : nullptr;
}

Eigen::Map<Vector6> six_at(std::span<double> values, LocalIndex node) {
  return Eigen::Map<Vector6>(values.data() + 6 * static_cast<std::size_t>(node));
}

std::size_t index_of(LocalIndex node, std::vector<LocalIndex>& nodes) {
  const auto found = std::ranges::find(nodes, node);
  if (found != nodes.end()) return static_cast<std::size_t>(found - nodes.begin());
  nodes.push_back(node);
  return nodes.size() - 1;
}

/// Returns the carriers of the given nodes.
std::vector<LocalIndex> carriers_of(const CarriedNodes& carried, std::span<const LocalIndex> nodes) {
  std::vector<LocalIndex> all;
  for (const LocalIndex node : nodes) {
    const CarriedNode* at = carried.find(node);
    if (!at || !at->own.isZero(0)) index_of(node, all);
    if (!at) continue;
    for (const auto& [carrier, block] : at->carriers) index_of(carrier, all);
  }
  return all;
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

const CarriedNode* CarriedNodes::find(LocalIndex node) const {
  const auto found = std::ranges::lower_bound(nodes, node, {}, &CarriedNode::node);
  return found != nodes.end() && found->node == node ? &*found : nullptr;
}

void carry(const Space& space, algebra::Vector& y) {
  if (!space.carried) return;
  // Carried nodes may carry others: all values are computed before any is changed.
  std::vector<Vector6> moved;
  moved.reserve(space.carried->nodes.size());
  for (const CarriedNode& at : space.carried->nodes) {
    Vector6 sum = at.own * six_at(y.local(), at.node);
    for (const auto& [carrier, block] : at.carriers) sum += block * six_at(y.local(), carrier);
    moved.push_back(sum);
  }
  for (std::size_t i = 0; i < moved.size(); ++i) six_at(y.local(), space.carried->nodes[i].node) = moved[i];
}

void hand_back(const Space& space, algebra::Vector& f) {
  if (!space.carried) return;
  std::ranges::fill(f.local().subspan(f.owned().size()), 0.0);
  std::vector<std::pair<const CarriedNode*, Vector6>> handed;
  for (const CarriedNode& at : space.carried->nodes) {
    if (at.node >= space.layout->owned) continue;
    handed.emplace_back(&at, six_at(f.local(), at.node));
    six_at(f.local(), at.node).setZero();
  }
  for (const auto& [at, force] : handed) {
    six_at(f.local(), at->node) += at->own.transpose() * force;
    for (const auto& [carrier, block] : at->carriers) six_at(f.local(), carrier) += block.transpose() * force;
  }
  f.accumulate_ghosts();
}

NodeBlocks on_carriers(const Space& space, NodeBlocks on_nodes) {
  if (!space.carried) return on_nodes;
  const CarriedNodes& carried = *space.carried;
  if (std::ranges::none_of(on_nodes.nodes, [&](LocalIndex node) { return carried.find(node) != nullptr; }))
    return on_nodes;
  NodeBlocks result{.nodes = carriers_of(carried, on_nodes.nodes)};
  result.matrix.setZero(on_nodes.matrix.rows(), 6 * static_cast<Eigen::Index>(result.nodes.size()));
  const auto columns = [&](LocalIndex node) {
    return result.matrix.middleCols<6>(6 * static_cast<Eigen::Index>(index_of(node, result.nodes)));
  };
  for (std::size_t i = 0; i < on_nodes.nodes.size(); ++i) {
    const auto given = on_nodes.matrix.middleCols<6>(6 * static_cast<Eigen::Index>(i));
    const CarriedNode* at = carried.find(on_nodes.nodes[i]);
    if (!at) {
      columns(on_nodes.nodes[i]) += given;
      continue;
    }
    if (!at->own.isZero(0)) columns(at->node) += given * at->own;
    for (const auto& [carrier, block] : at->carriers) columns(carrier) += given * block;
  }
  return result;
}

algebra::Connectivity coupled_carriers(const Space& space) {
  algebra::Connectivity coupled = coupled_nodes(space);
  if (!space.carried) return coupled;
  algebra::Connectivity on_them{.nodes_per_element = 0, .nodes = {}, .start = {0}};
  for (std::size_t cell = 0; cell < space.cells.size(); ++cell) {
    const auto nodes = carriers_of(*space.carried, coupled.element(cell));
    on_them.nodes.insert(on_them.nodes.end(), nodes.begin(), nodes.end());
    on_them.start.push_back(on_them.nodes.size());
  }
  return on_them;
}

bool is_kinked(const CarriedNodes& carried, const CarriedNode& node) {
  const auto place = static_cast<std::size_t>(&node - carried.nodes.data());
  return std::ranges::none_of(carried.bodies,
                              [&](const PlacedBody& body) { return std::ranges::binary_search(body.members, place); });
}

void collect_at_kinks(const Space& space, algebra::Vector& values) {
  if (!space.carried) return;
  const auto all = values.local();
  std::ranges::fill(all.subspan(values.owned().size()), 0.0);
  for (const CarriedNode& at : space.carried->nodes) {
    if (at.node >= space.layout->owned || !is_kinked(*space.carried, at)) continue;
    double& own = all[at.node];
    all[at.carriers[0].first] += own;
    own = 0;
  }
  values.accumulate_ghosts();
}

}  // namespace plastron::fem

#include <plastron/fem/carried_nodes.hpp>

#include <plastron/fem/ties.hpp>

#include <algorithm>

namespace plastron::fem {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using algebra::LocalIndex;

Eigen::Map<Vector6> six_at(std::span<double> values, LocalIndex node) {
  return Eigen::Map<Vector6>(values.data() + 6 * static_cast<std::size_t>(node));
}

std::size_t place_of(LocalIndex node, std::vector<LocalIndex>& nodes) {
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
    if (!at || !at->own.isZero(0)) place_of(node, all);
    if (!at) continue;
    for (const auto& [carrier, block] : at->carriers) place_of(carrier, all);
  }
  return all;
}

}  // namespace

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
    return result.matrix.middleCols<6>(6 * static_cast<Eigen::Index>(place_of(node, result.nodes)));
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

}  // namespace plastron::fem

#include <plastron/fem/join.hpp>

#include <plastron/fem/kinks.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace plastron::fem {

namespace {

using algebra::GlobalIndex, algebra::LocalIndex;
using Eigen::Vector3d;

double length_of(const std::vector<BoundaryNode>& nodes) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const BoundaryNode& node : nodes) {
    low = low.cwiseMin(node.place);
    high = high.cwiseMax(node.place);
  }
  return (high - low).norm();
}

/// Classes of identified nodes; the representative is the smallest number.
class Classes {
 public:
  GlobalIndex representative(GlobalIndex node) const {
    for (auto at = parent_.find(node); at != parent_.end(); at = parent_.find(node)) node = at->second;
    return node;
  }
  void unite(GlobalIndex a, GlobalIndex b) {
    a = representative(a);
    b = representative(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }
  bool is_tied(GlobalIndex node) const { return parent_.contains(node); }
  bool is_empty() const { return parent_.empty(); }

 private:
  std::map<GlobalIndex, GlobalIndex> parent_;
};

/// Relations between the nodes of joined edges.
struct JoinedEdges {
  Classes same{};
  std::vector<Kink> kinks{};
};

void unite_partners(const Join& join, const std::array<std::vector<BoundaryNode>, 2>& sides, JoinedEdges& edges) {
  constexpr double same_place = 1e-8, same_normal = 1e-6, opposite_normal = 1e-3;
  const double length = length_of(sides[0]);
  const auto& [first, second] = join.boundaries;
  if (sides[0].size() != sides[1].size())
    throw DomainError(fmt::format(
        "the edges \"{}\" and \"{}\" cannot be joined: they have {} and {} nodes; divide both into the same cells",
        first, second, sides[0].size(), sides[1].size()));
  for (const BoundaryNode& node : sides[1]) {
    const auto distance = [&](const BoundaryNode& other) { return (other.place - node.place).norm(); };
    const BoundaryNode& partner = *std::ranges::min_element(sides[0], {}, distance);
    if (!(distance(partner) <= same_place * length))
      throw DomainError(
          fmt::format("the edges \"{}\" and \"{}\" cannot be joined: the point ({:.6g}, {:.6g}, {:.6g}) of \"{}\" is "
                      "{:.3g} m from the nearest node of \"{}\"; joined edges lie on each other in space and are "
                      "divided alike",
                      first, second, node.place[0], node.place[1], node.place[2], second, distance(partner), first));
    if ((partner.normal + node.normal).norm() <= opposite_normal)
      throw DomainError(fmt::format(
          "the edges \"{}\" and \"{}\" cannot be joined: at ({:.6g}, {:.6g}, {:.6g}) a_3 points to opposite sides; "
          "exchange x and y in one of the charts",
          first, second, node.place[0], node.place[1], node.place[2]));
    if ((partner.normal - node.normal).norm() <= same_normal)
      edges.same.unite(node.node, partner.node);
    else
      edges.kinks.push_back({{partner, node}});
  }
}

/// Ties identified nodes to their representatives and adds nodes carried across a kink.
void add_ties(const Classes& same, const std::map<GlobalIndex, KinkedNode>& kinked, Space& space) {
  const algebra::Distribution before = *space.layout;
  std::set<GlobalIndex> masters;
  for (LocalIndex i = 0; i < before.local_size(); ++i) {
    const GlobalIndex node = same.representative(before.global(i));
    if (same.is_tied(before.global(i))) masters.insert(node);
    if (const auto found = kinked.find(node); found != kinked.end())
      for (const auto& [carrier, block] : found->second.carriers) masters.insert(carrier);
  }
  widen(space, masters);
  const algebra::Layout& after = *space.layout;
  auto carried = std::make_shared<CarriedNodes>();
  for (LocalIndex i = 0; i < after.local_size(); ++i) {
    const GlobalIndex node = after.global(i);
    if (same.is_tied(node)) space.ties.push_back({i, {{after.local(same.representative(node)), 1.0}}});
    const auto found = kinked.find(node);
    if (found == kinked.end()) continue;
    CarriedNode& at = carried->nodes.emplace_back(CarriedNode{.node = i, .own = found->second.own});
    for (const auto& [carrier, block] : found->second.carriers) at.carriers.emplace_back(after.local(carrier), block);
  }
  // Sorted with the ties of hanging nodes, which never lie on a joined edge.
  std::ranges::sort(space.ties, {}, &Tie::node);
  space.has_ties = space.has_ties || !same.is_empty();
  if (!kinked.empty()) space.carried = std::move(carried);
}

}  // namespace

std::shared_ptr<const Space> joined(std::shared_ptr<const Space> space, const Surface& surface,
                                    const std::vector<Join>& joins) {
  if (joins.empty()) return space;
  JoinedEdges edges;
  std::set<int> boundaries;
  for (const Join& join : joins) {
    std::array<std::vector<BoundaryNode>, 2> sides;
    for (std::size_t k = 0; k < 2; ++k) {
      const int boundary = boundary_index(*space->coarse, join.boundaries[k], "an edge of a join");
      boundaries.insert(boundary);
      sides[k] = nodes_on(*space, surface, boundary);
    }
    unite_partners(join, sides, edges);
  }
  auto result = std::make_shared<Space>(*space);
  for (Kink& kink : edges.kinks)
    for (BoundaryNode& node : kink.nodes) node.node = edges.same.representative(node.node);
  add_ties(edges.same, kinked_nodes(edges.kinks), *result);
  // The shell does not end at joined edges.
  for (BoundarySide& side : result->sides)
    if (boundaries.contains(side.boundary)) side.is_inner = true;
  return result;
}

}  // namespace plastron::fem

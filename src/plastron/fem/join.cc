#include <plastron/fem/join.hpp>

#include <plastron/fem/boundary_nodes.hpp>

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

/// Classes of nodes that are one; the representative is the smallest number.
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

 private:
  std::map<GlobalIndex, GlobalIndex> parent_;
};

void unite_partners(const Join& join, const std::array<std::vector<BoundaryNode>, 2>& sides, Classes& classes) {
  constexpr double same_place = 1e-8, same_normal = 1e-6;
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
    if (!((partner.normal - node.normal).norm() <= same_normal))
      throw DomainError(
          fmt::format("the edges \"{}\" and \"{}\" cannot be joined: at ({:.6g}, {:.6g}, {:.6g}) a_3 is ({:.3g}, "
                      "{:.3g}, {:.3g}) on one and "
                      "({:.3g}, {:.3g}, {:.3g}) on the other; shells that meet at an angle are not joined by this "
                      "version, and where "
                      "a_3 points the other way, exchange x and y in one of the charts",
                      first, second, node.place[0], node.place[1], node.place[2], partner.normal[0], partner.normal[1],
                      partner.normal[2], node.normal[0], node.normal[1], node.normal[2]));
    classes.unite(node.node, partner.node);
  }
}

}  // namespace

std::shared_ptr<const Space> joined(std::shared_ptr<const Space> space, const Surface& surface,
                                    const std::vector<Join>& joins) {
  if (joins.empty()) return space;
  Classes classes;
  std::set<int> boundaries;
  for (const Join& join : joins) {
    std::array<std::vector<BoundaryNode>, 2> sides;
    for (std::size_t k = 0; k < 2; ++k) {
      const int boundary = boundary_index(*space->coarse, join.boundaries[k], "an edge of a join");
      boundaries.insert(boundary);
      sides[k] = nodes_on(*space, surface, boundary);
    }
    unite_partners(join, sides, classes);
  }
  auto result = std::make_shared<Space>(*space);
  std::set<GlobalIndex> masters;
  for (LocalIndex i = 0; i < space->layout->local_size(); ++i)
    if (const GlobalIndex node = space->layout->global(i); classes.is_tied(node))
      masters.insert(classes.representative(node));
  widen(*result, masters);
  for (LocalIndex i = 0; i < result->layout->local_size(); ++i)
    if (const GlobalIndex node = result->layout->global(i); classes.is_tied(node))
      result->ties.push_back({i, {{local_in(*result->layout, classes.representative(node)), 1.0}}});
  result->has_ties = true;
  // The shell does not end there.
  for (BoundarySide& side : result->sides)
    if (boundaries.contains(side.boundary)) side.is_inner = true;
  return result;
}

}  // namespace plastron::fem

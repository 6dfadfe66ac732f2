// Joined edges, whose nodes are equal, and kinks, where shells meet at an angle.
#include <plastron/constraints/map.hpp>
#include <plastron/fem/boundary_nodes.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/fem/kinks.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/mesh/reference_cell.hpp>

#include <fmt/format.h>
#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

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
  bool is_represented(GlobalIndex node) const { return parent_.contains(node); }  ///< by another node

 private:
  std::map<GlobalIndex, GlobalIndex> parent_;
};

/// A hinge with a stiffness. `partners`: nodes of the first edge by those of the second one, which is `boundary`.
struct Hinge {
  int boundary = 0;
  double stiffness = 0;
  std::map<GlobalIndex, GlobalIndex> partners{};
};

/// Relations between the nodes of joined edges.
struct JoinedEdges {
  Classes same{};
  std::vector<Kink> kinks{};
  std::vector<Hinge> hinges{};
};

void unite_partners(const Join& join, const std::array<std::vector<BoundaryNode>, 2>& sides, JoinedEdges& edges) {
  constexpr double same_place = 1e-8, same_normal = 1e-6, opposite_normal = 1e-3;
  const double length = length_of(sides[0]);
  const auto& [first, second] = join.boundaries;
  if (sides[0].size() != sides[1].size())
    throw mesh::DomainError(fmt::format(
        "the edges \"{}\" and \"{}\" cannot be joined: they have {} and {} nodes; divide both into the same cells",
        first, second, sides[0].size(), sides[1].size()));
  for (const BoundaryNode& node : sides[1]) {
    const auto distance = [&](const BoundaryNode& other) { return (other.place - node.place).norm(); };
    const BoundaryNode& partner = *std::ranges::min_element(sides[0], {}, distance);
    if (!(distance(partner) <= same_place * length))
      throw mesh::DomainError(
          fmt::format("the edges \"{}\" and \"{}\" cannot be joined: the point ({:.6g}, {:.6g}, {:.6g}) of \"{}\" is "
                      "{:.3g} m from the nearest node of \"{}\"; joined edges lie on each other in space and are "
                      "divided alike",
                      first, second, node.place[0], node.place[1], node.place[2], second, distance(partner), first));
    if ((partner.normal + node.normal).norm() <= opposite_normal)
      throw mesh::DomainError(fmt::format(
          "the edges \"{}\" and \"{}\" cannot be joined: at ({:.6g}, {:.6g}, {:.6g}) a_3 points to opposite sides; "
          "exchange x and y in one of the charts",
          first, second, node.place[0], node.place[1], node.place[2]));
    if (!join.is_hinge && (partner.normal - node.normal).norm() <= same_normal)
      edges.same.unite(node.node, partner.node);
    else
      edges.kinks.push_back({{partner, node}, join.is_hinge});
    if (join.stiffness > 0) edges.hinges.back().partners[node.node] = partner.node;
  }
}

/// Returns the axis about which two shells turn together at a node of a fold. It is normal to both directors, as the
/// fold's tangent is on the exact surface; a rigid motion then satisfies the condition of the kink exactly.
Vector3d fold_axis(const BoundaryNode& first, const BoundaryNode& second) {
  constexpr double parallel = 0.01;
  const Vector3d axis = first.normal.normalized().cross(second.normal.normalized());
  if (axis.norm() > parallel) return axis.normalized();
  return geometry::tangential(first.along, first.normal.normalized()).normalized();
}

/// Adds the kinks at the folds of a mesh in space.
void add_folds(const Space& space, const Surface& surface, JoinedEdges& edges) {
  constexpr double same_place = 1e-8;
  const auto all = fold_nodes(space, surface);
  for (std::size_t edge = 0; edge < all.size(); edge += 2) {
    const std::vector<BoundaryNode>&one = all[edge], &other = all[edge + 1];
    PLASTRON_ASSERT(one.size() == other.size(), one.size(), other.size());
    for (const BoundaryNode& node : one) {
      const auto distance = [&](const BoundaryNode& partner) { return (partner.place - node.place).norm(); };
      BoundaryNode first = node, second = *std::ranges::min_element(other, {}, distance);
      PLASTRON_ASSERT(distance(second) <= same_place * length_of(one), distance(second));
      if (first.node == second.node) continue;  // the end of a fold inside a sheet
      first.along = second.along = fold_axis(first, second);
      edges.kinks.push_back({{first, second}});
    }
  }
}

/// Adds the rows of identified nodes and of nodes at kinks. Each rank sees all nodes of a kink or none.
void add_joined_rows(const Classes& same, const std::map<GlobalIndex, KinkedNode>& kinked, Space& space) {
  const algebra::Distribution before = *space.layout;
  const auto decides = [&](GlobalIndex node) {
    const auto found = kinked.find(node);
    return found == kinked.end() ? node : found->second.sources.front().first;
  };
  std::set<GlobalIndex> wanted, deciding_here;
  for (LocalIndex i = 0; i < before.local_size(); ++i) {
    const GlobalIndex node = same.representative(before.global(i));
    if (same.is_represented(before.global(i))) wanted.insert(node);
    deciding_here.insert(decides(node));
  }
  for (const auto& [node, row] : kinked)
    if (deciding_here.contains(decides(node))) wanted.insert({node, decides(node)});
  widen(space, wanted);
  const algebra::Layout& after = *space.layout;
  std::vector<constraints::Row> equal, at_kinks, deciding;
  for (LocalIndex i = 0; i < after.local_size(); ++i) {
    const GlobalIndex node = after.global(i);
    if (same.is_represented(node)) equal.push_back({i, {{.node = after.local(same.representative(node))}}});
    const auto found = kinked.find(node);
    if (found == kinked.end()) continue;
    at_kinks.push_back(row_of(after, i, found->second));
    deciding.push_back({i, {{.node = at_kinks.back().terms.front().node}}});
  }
  space.continuity = compose(space.continuity, constraints::Map(std::move(equal), after.comm), after.comm);
  space.kinks = constraints::Map(std::move(deciding), after.comm);
  space.constraints = compose(space.continuity, constraints::Map(std::move(at_kinks), after.comm), after.comm);
}

void add_hinges(const JoinedEdges& edges, Space& space) {
  for (const Hinge& hinge : edges.hinges)
    for (const BoundarySide& side : space.sides) {
      if (side.boundary != hinge.boundary || side.cell >= space.owned_cells) continue;
      HingeSide& added =
          space.hinges.emplace_back(HingeSide{.cell = side.cell, .side = side.side, .stiffness = hinge.stiffness});
      for (const int node : mesh::side_nodes(space.shape(), space.degree, side.side))
        added.partners.push_back(edges.same.representative(
            hinge.partners.at(space.layout->global(space.nodes(side.cell)[static_cast<std::size_t>(node)]))));
    }
}

}  // namespace

std::vector<LocalIndex> Space::nodes(const HingeSide& hinge) const {
  std::vector<LocalIndex> all;
  for (const int node : mesh::side_nodes(shape(), degree, hinge.side))
    all.push_back(nodes(hinge.cell)[static_cast<std::size_t>(node)]);
  for (const GlobalIndex partner : hinge.partners) all.push_back(layout->local(partner));
  return all;
}

algebra::Connectivity Space::couplings() const {
  algebra::Connectivity all = constraints.couplings(connectivity);
  if (hinges.empty()) return all;
  if (all.start.empty())
    for (std::size_t e = 0, end = all.elements(); e <= end; ++e)
      all.start.push_back(e * static_cast<std::size_t>(all.nodes_per_element));
  for (const HingeSide& hinge : hinges) {
    const std::vector<LocalIndex> sources = constraints.sources(nodes(hinge));
    all.nodes.insert(all.nodes.end(), sources.begin(), sources.end());
    all.start.push_back(all.nodes.size());
  }
  return all;
}

std::shared_ptr<const Space> joined(std::shared_ptr<const Space> space, const Surface& surface,
                                    const std::vector<Join>& joins) {
  if (joins.empty() && space->coarse->folds.empty()) return space;
  JoinedEdges edges;
  std::set<int> boundaries;
  for (const Join& join : joins) {
    std::array<std::vector<BoundaryNode>, 2> sides;
    for (std::size_t k = 0; k < 2; ++k) {
      const int boundary = boundary_index(*space->coarse, join.boundaries[k], "an edge of a join");
      boundaries.insert(boundary);
      sides[k] = nodes_on(*space, surface, boundary);
      if (k == 1 && join.stiffness > 0) edges.hinges.push_back({.boundary = boundary, .stiffness = join.stiffness});
    }
    unite_partners(join, sides, edges);
  }
  add_folds(*space, surface, edges);
  auto result = std::make_shared<Space>(*space);
  for (Kink& kink : edges.kinks)
    for (BoundaryNode& node : kink.nodes) node.node = edges.same.representative(node.node);
  // A hinge may end inside a sheet.
  std::erase_if(edges.kinks, [](const Kink& kink) { return kink.nodes[0].node == kink.nodes[1].node; });
  add_joined_rows(edges.same, expressed(edges.kinks).nodes, *result);
  add_hinges(edges, *result);
  // The shell does not end at joined edges.
  for (BoundarySide& side : result->sides)
    if (boundaries.contains(side.boundary)) side.is_inner = true;
  return result;
}

}  // namespace plastron::fem

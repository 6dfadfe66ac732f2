// Joined edges, whose nodes are equal, and kinks, where shells meet at an angle.
#include <plastron/constraints/map.hpp>
#include <plastron/fem/boundary_nodes.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/geometry/frame.hpp>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <deque>
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

/// Two nodes at the same place with different normals.
struct Kink {
  std::array<BoundaryNode, 2> nodes;
};

/// The row of a node at a kink, as known to all ranks.
struct KinkedNode {
  Matrix6 own = Matrix6::Zero();
  std::vector<std::pair<GlobalIndex, Matrix6>> sources{};  ///< other nodes; the first one determines u
};

/// The nodes that determine a node's (u, r), possibly with the node itself, and their matrices.
using Expression = std::map<GlobalIndex, Matrix6>;

/// One condition of a node: its r . `direction` equals the other's r . `other_direction`.
struct TurnsWith {
  GlobalIndex other;
  Vector3d direction, other_direction;
};

/// The direction D with (w x d) . D = w . along for every rotation w, if d is normal to `along`. Directors of meshes in
/// space need not be unit vectors.
Vector3d turning(const Vector3d& along, const Vector3d& director) {
  return along.cross(director) / director.squaredNorm();
}

/// Expresses the nodes of connected kinks by each other, beginning with the smallest node. Throws DomainError if a node
/// would have to turn with more than two others about different tangents.
class KinkedGroups {
 public:
  explicit KinkedGroups(const std::vector<Kink>& kinks) {
    for (const Kink& kink : kinks)
      for (std::size_t k = 0; k < 2; ++k) {
        const BoundaryNode &node = kink.nodes[k], &other = kink.nodes[1 - k];
        const Vector3d& along = kink.nodes[0].along;
        at_.emplace(node.node, node);
        neighbours_[node.node].push_back({other.node, turning(along, node.normal), turning(along, other.normal)});
      }
  }

  /// Returns all nodes with a row by number.
  std::map<GlobalIndex, KinkedNode> kinked() {
    for (const auto& [node, unused] : neighbours_)
      if (!expressed_.contains(node)) go_through(node);
    return std::move(kinked_);
  }

 private:
  void go_through(GlobalIndex first) {
    expressed_[first] = {{first, Matrix6::Identity()}};
    std::deque<GlobalIndex> waiting{first};
    std::set<GlobalIndex> seen{first};
    while (!waiting.empty()) {
      const GlobalIndex node = waiting.front();
      waiting.pop_front();
      if (node != first) express(node);
      for (const TurnsWith& next : neighbours_[node])
        if (seen.insert(next.other).second) waiting.push_back(next.other);
    }
  }

  /// Independent conditions of a node with nodes that are already expressed.
  std::vector<TurnsWith> conditions(GlobalIndex node) const {
    constexpr double parallel = 1e-6;
    std::vector<TurnsWith> all;
    for (const TurnsWith& next : neighbours_.at(node)) {
      if (!expressed_.contains(next.other)) continue;
      if (std::ranges::any_of(
              all, [&](const TurnsWith& known) { return known.direction.cross(next.direction).norm() < parallel; }))
        continue;
      all.push_back(next);
    }
    if (all.size() > 2) {
      const Vector3d& place = at_.at(node).place;
      throw mesh::DomainError(
          fmt::format("edges cannot be joined: at ({:.6g}, {:.6g}, {:.6g}) a shell meets others at angles along three "
                      "directions; at most two are joined there",
                      place[0], place[1], place[2]));
    }
    return all;
  }

  void express(GlobalIndex node) {
    const auto turns = conditions(node);
    const Vector3d a3 = at_.at(node).normal.normalized();
    Expression& all = expressed_[node];
    for (const auto& [source, block] : expressed_.at(turns[0].other))
      all.try_emplace(source, Matrix6::Zero()).first->second.topRows<3>() += block.topRows<3>();
    const auto dual = dual_directions(turns, a3);
    for (std::size_t k = 0; k < turns.size(); ++k)
      for (const auto& [source, block] : expressed_.at(turns[k].other))
        all.try_emplace(source, Matrix6::Zero()).first->second.bottomRows<3>() +=
            dual[k] * (turns[k].other_direction.transpose() * block.bottomRows<3>());
    const GlobalIndex decides_u = std::ranges::find_if(all, [](const auto& entry) {
                                    return !entry.second.template topRows<3>().isZero(0);
                                  })->first;
    KinkedNode& kinked = kinked_[node];
    kinked.sources.emplace_back(decides_u, all.at(decides_u));
    constexpr double rounding = 1e-12;  // relative to products of unit vectors
    for (const auto& entry : all)
      if (entry.first != decides_u && entry.second.norm() > rounding) kinked.sources.emplace_back(entry);
    kinked.own.bottomRightCorner<3, 3>() = a3 * a3.transpose();
    if (turns.size() == 1) {
      const Vector3d along = turns[0].direction.cross(a3).normalized();
      kinked.own.bottomRightCorner<3, 3>() += along * along.transpose();
    }
    all[node] = kinked.own;
  }

  /// Tangential vectors dual to the directions: their products with the directions are one and zero.
  static std::vector<Vector3d> dual_directions(const std::vector<TurnsWith>& turns, const Vector3d& a3) {
    if (turns.size() == 1) return {turns[0].direction / turns[0].direction.squaredNorm()};
    const double area = a3.dot(turns[0].direction.cross(turns[1].direction));
    return {turns[1].direction.cross(a3) / area, a3.cross(turns[0].direction) / area};
  }

  std::map<GlobalIndex, BoundaryNode> at_;
  std::map<GlobalIndex, std::vector<TurnsWith>> neighbours_;
  std::map<GlobalIndex, Expression> expressed_;
  std::map<GlobalIndex, KinkedNode> kinked_;
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
    if ((partner.normal - node.normal).norm() <= same_normal)
      edges.same.unite(node.node, partner.node);
    else
      edges.kinks.push_back({{partner, node}});
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

/// Adds the rows of identified nodes and of nodes at kinks.
void add_joined_rows(const Classes& same, const std::map<GlobalIndex, KinkedNode>& kinked, Space& space) {
  const algebra::Distribution before = *space.layout;
  std::set<GlobalIndex> wanted;
  for (LocalIndex i = 0; i < before.local_size(); ++i) {
    const GlobalIndex node = same.representative(before.global(i));
    if (same.is_represented(before.global(i))) wanted.insert(node);
    if (const auto found = kinked.find(node); found != kinked.end())
      for (const auto& [source, block] : found->second.sources) wanted.insert(source);
  }
  widen(space, wanted);
  const algebra::Layout& after = *space.layout;
  std::vector<constraints::Row> equal, at_kinks, deciding;
  for (LocalIndex i = 0; i < after.local_size(); ++i) {
    const GlobalIndex node = after.global(i);
    if (same.is_represented(node)) equal.push_back({i, {{.node = after.local(same.representative(node))}}});
    const auto found = kinked.find(node);
    if (found == kinked.end()) continue;
    constraints::Row& row = at_kinks.emplace_back(constraints::Row{.node = i});
    for (const auto& [source, block] : found->second.sources)
      row.terms.push_back(constraints::term(after.local(source), block));
    deciding.push_back({i, {{.node = row.terms.front().node}}});
    row.terms.push_back(constraints::term(i, found->second.own));
  }
  space.continuity = compose(space.continuity, constraints::Map(std::move(equal), after.comm), after.comm);
  space.kinks = constraints::Map(std::move(deciding), after.comm);
  space.constraints = compose(space.continuity, constraints::Map(std::move(at_kinks), after.comm), after.comm);
}

}  // namespace

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
    }
    unite_partners(join, sides, edges);
  }
  add_folds(*space, surface, edges);
  auto result = std::make_shared<Space>(*space);
  for (Kink& kink : edges.kinks)
    for (BoundaryNode& node : kink.nodes) node.node = edges.same.representative(node.node);
  add_joined_rows(edges.same, KinkedGroups(edges.kinks).kinked(), *result);
  // The shell does not end at joined edges.
  for (BoundarySide& side : result->sides)
    if (boundaries.contains(side.boundary)) side.is_inner = true;
  return result;
}

}  // namespace plastron::fem

#include <plastron/fem/kinks.hpp>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <deque>
#include <set>

namespace plastron::fem {

namespace {

using algebra::GlobalIndex;
using Eigen::Matrix3d, Eigen::Vector3d;

/// The carriers of a node, possibly with the node itself, and their matrices.
using Expression = std::map<GlobalIndex, Matrix6>;

/// One condition of a node: its r . `direction` equals the other's r . `other_direction`.
struct TurnsWith {
  GlobalIndex other;
  Vector3d direction, other_direction;
};

class KinkedGroups {
 public:
  explicit KinkedGroups(const std::vector<Kink>& kinks) {
    for (const Kink& kink : kinks)
      for (std::size_t k = 0; k < 2; ++k) {
        const BoundaryNode &node = kink.nodes[k], &other = kink.nodes[1 - k];
        const Vector3d& along = kink.nodes[0].along;
        at_.emplace(node.node, node);
        neighbours_[node.node].push_back({other.node, along.cross(node.normal), along.cross(other.normal)});
      }
  }

  std::map<GlobalIndex, KinkedNode> carried() {
    for (const auto& [node, unused] : neighbours_)
      if (!expressed_.contains(node)) go_through(node);
    return std::move(carried_);
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
      throw DomainError(
          fmt::format("edges cannot be joined: at ({:.6g}, {:.6g}, {:.6g}) a shell meets others at angles along three "
                      "directions; at most two are joined there",
                      place[0], place[1], place[2]));
    }
    return all;
  }

  void express(GlobalIndex node) {
    const auto turns = conditions(node);
    const Vector3d& a3 = at_.at(node).normal;
    Expression& all = expressed_[node];
    for (const auto& [carrier, block] : expressed_.at(turns[0].other))
      all.try_emplace(carrier, Matrix6::Zero()).first->second.topRows<3>() += block.topRows<3>();
    const auto dual = dual_directions(turns, a3);
    for (std::size_t k = 0; k < turns.size(); ++k)
      for (const auto& [carrier, block] : expressed_.at(turns[k].other))
        all.try_emplace(carrier, Matrix6::Zero()).first->second.bottomRows<3>() +=
            dual[k] * (turns[k].other_direction.transpose() * block.bottomRows<3>());
    const GlobalIndex decides_u = std::ranges::find_if(all, [](const auto& entry) {
                                    return !entry.second.template topRows<3>().isZero(0);
                                  })->first;
    KinkedNode& kinked = carried_[node];
    kinked.carriers.emplace_back(decides_u, all.at(decides_u));
    constexpr double rounding = 1e-12;  // relative to products of unit vectors
    for (const auto& entry : all)
      if (entry.first != decides_u && entry.second.norm() > rounding) kinked.carriers.emplace_back(entry);
    kinked.own.bottomRightCorner<3, 3>() = a3 * a3.transpose();
    if (turns.size() == 1) {
      const Vector3d along = turns[0].direction.cross(a3);
      kinked.own.bottomRightCorner<3, 3>() += along * along.transpose();
    }
    all[node] = kinked.own;
  }

  /// Tangential vectors dual to the directions: their products with the directions are one and zero.
  static std::vector<Vector3d> dual_directions(const std::vector<TurnsWith>& turns, const Vector3d& a3) {
    if (turns.size() == 1) return {turns[0].direction};
    const double area = a3.dot(turns[0].direction.cross(turns[1].direction));
    return {turns[1].direction.cross(a3) / area, a3.cross(turns[0].direction) / area};
  }

  std::map<GlobalIndex, BoundaryNode> at_;
  std::map<GlobalIndex, std::vector<TurnsWith>> neighbours_;
  std::map<GlobalIndex, Expression> expressed_;
  std::map<GlobalIndex, KinkedNode> carried_;
};

}  // namespace

std::map<GlobalIndex, KinkedNode> kinked_nodes(const std::vector<Kink>& kinks) { return KinkedGroups(kinks).carried(); }

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
    double& own = all[static_cast<std::size_t>(at.node)];
    all[static_cast<std::size_t>(at.carriers[0].first)] += own;
    own = 0;
  }
  values.accumulate_ghosts();
}

}  // namespace plastron::fem

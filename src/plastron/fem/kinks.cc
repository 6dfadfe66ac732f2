#include <plastron/fem/kinks.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <deque>
#include <set>

namespace plastron::fem {

using algebra::GlobalIndex, algebra::LocalIndex;
using Eigen::Vector3d;

namespace {

/// The nodes that determine a node's (u, r), possibly with the node itself, and their matrices.
using Expression = std::map<GlobalIndex, Matrix6>;

/// One condition of a node: its r . `direction` equals the other's r . `other_direction`, unless a hinge is between them.
struct TurnsWith {
  GlobalIndex other;
  Vector3d direction, other_direction, along;
  bool is_hinge;
};

/// The direction D with (w x d) . D = w . along for every rotation w, if d is normal to `along`. Directors of meshes in
/// space need not be unit vectors.
Vector3d turning(const Vector3d& along, const Vector3d& director) {
  return along.cross(director) / director.squaredNorm();
}

class KinkedGroups {
 public:
  explicit KinkedGroups(const std::vector<Kink>& kinks) {
    for (const Kink& kink : kinks)
      for (std::size_t k = 0; k < 2; ++k) {
        const BoundaryNode &node = kink.nodes[k], &other = kink.nodes[1 - k];
        const Vector3d& along = kink.nodes[0].along;
        at_.emplace(node.node, node);
        neighbours_[node.node].push_back(
            {other.node, turning(along, node.normal), turning(along, other.normal), along, kink.is_hinge});
      }
  }

  ExpressedKinks expressed() {
    for (const auto& [node, unused] : neighbours_)
      if (!expressed_.contains(node)) go_through(node);
    return std::move(result_);
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
      if (next.is_hinge || !expressed_.contains(next.other)) continue;
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
    for (const TurnsWith& turn : turns) {
      Kink& kink = result_.sequence.emplace_back(Kink{{at_.at(turn.other), at_.at(node)}});
      for (BoundaryNode& end : kink.nodes) end.along = turn.along;
    }
    const Vector3d a3 = at_.at(node).normal.normalized();
    const auto known = std::ranges::find_if(neighbours_.at(node),
                                            [&](const TurnsWith& next) { return expressed_.contains(next.other); });
    Expression& all = expressed_[node];
    for (const auto& [source, block] : expressed_.at(known->other))
      all.try_emplace(source, Matrix6::Zero()).first->second.topRows<3>() += block.topRows<3>();
    const auto dual = dual_directions(turns, a3);
    for (std::size_t k = 0; k < turns.size(); ++k)
      for (const auto& [source, block] : expressed_.at(turns[k].other))
        all.try_emplace(source, Matrix6::Zero()).first->second.bottomRows<3>() +=
            dual[k] * (turns[k].other_direction.transpose() * block.bottomRows<3>());
    const GlobalIndex decides_u = std::ranges::find_if(all, [](const auto& entry) {
                                    return !entry.second.template topRows<3>().isZero(0);
                                  })->first;
    KinkedNode& kinked = result_.nodes[node];
    kinked.sources.emplace_back(decides_u, all.at(decides_u));
    constexpr double rounding = 1e-12;  // relative to products of unit vectors
    for (const auto& entry : all)
      if (entry.first != decides_u && entry.second.norm() > rounding) kinked.sources.emplace_back(entry);
    kinked.own.bottomRightCorner<3, 3>() = a3 * a3.transpose();
    if (turns.empty()) kinked.own.bottomRightCorner<3, 3>().setIdentity();
    if (turns.size() == 1) {
      const Vector3d along = turns[0].direction.cross(a3).normalized();
      kinked.own.bottomRightCorner<3, 3>() += along * along.transpose();
    }
    all[node] = kinked.own;
  }

  /// Tangential vectors dual to the directions: their products with the directions are one and zero.
  static std::vector<Vector3d> dual_directions(const std::vector<TurnsWith>& turns, const Vector3d& a3) {
    if (turns.empty()) return {};
    if (turns.size() == 1) return {turns[0].direction / turns[0].direction.squaredNorm()};
    const double area = a3.dot(turns[0].direction.cross(turns[1].direction));
    return {turns[1].direction.cross(a3) / area, a3.cross(turns[0].direction) / area};
  }

  std::map<GlobalIndex, BoundaryNode> at_;
  std::map<GlobalIndex, std::vector<TurnsWith>> neighbours_;
  std::map<GlobalIndex, Expression> expressed_;
  ExpressedKinks result_;
};

}  // namespace

ExpressedKinks expressed(const std::vector<Kink>& kinks) { return KinkedGroups(kinks).expressed(); }

constraints::Row row_of(const algebra::Layout& layout, LocalIndex node, const KinkedNode& kinked) {
  constraints::Row row{.node = node};
  for (const auto& [source, block] : kinked.sources)
    row.terms.push_back(constraints::term(layout.local(source), block));
  row.terms.push_back(constraints::term(node, kinked.own));
  return row;
}

}  // namespace plastron::fem

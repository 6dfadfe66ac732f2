#include <plastron/estimation/reactions.hpp>

#include <plastron/solution/support_shares.hpp>

#include <algorithm>

namespace plastron::estimation {

namespace {

using Eigen::Vector3d;

/// Weight of a fixed coordinate's multiplier in a force.
struct WeightedMultiplier {
  std::size_t unknown;
  Vector3d weight;
};

/// A component of the sum of weight times multiplier, or the norm of the sum.
Derivative weigh(const std::vector<WeightedMultiplier>& all, const std::optional<int>& component,
                 const Solved& solved) {
  Vector3d force = Vector3d::Zero();
  for (const WeightedMultiplier& m : all) force += solved.z.multiplier.owned()[m.unknown] * m.weight;
  const MPI_Comm comm = solved.discrete.space().layout->comm;
  for (double& f : force) f = algebra::sum_over_ranks(f, comm);
  Vector3d direction = Vector3d::Zero();
  if (component)
    direction[*component] = 1;
  else if (force.norm() > 0)
    direction = force.normalized();
  const algebra::Vector none(solved.box.load.layout(), solved.box.load.block());
  Derivative result{.value = direction.dot(force), .dual = {.load = none, .held = none}};
  for (const WeightedMultiplier& m : all) result.dual.held.owned()[m.unknown] -= direction.dot(m.weight);
  result.force_direction = direction;
  return result;
}

bool is_active(const assembly::ContactRow& row, const Solved& solved) {
  if (!row.binds) return false;
  const auto bound = row.scale > 0 ? contact::Activity::at_lower : contact::Activity::at_upper;
  return solved.z.activity[solved.discrete.coordinates.at(row.node, row.coordinate)] == bound;
}

/// The counted part of each force of supports at an owned node: all of it, or the boundary's share.
class Counted {
 public:
  Counted(const SupportForce& force, const assembly::DiscreteShell& discrete) {
    if (!force.boundary) return;
    shares_.emplace(discrete);
    const auto found = std::ranges::find(shares_->boundaries(), *force.boundary);
    boundary_ = static_cast<std::size_t>(found - shares_->boundaries().begin());
  }
  /// The part of a unit force along a direction of (u, r).
  Vector3d operator()(std::size_t node, const assembly::Vector6& direction) const {
    if (!shares_) return direction.head<3>();
    const auto& all = shares_->at(node);
    const auto own = std::ranges::find(all, boundary_, &solution::SupportShares::Share::carrier);
    return own == all.end() ? Vector3d(Vector3d::Zero()) : Vector3d((own->part * direction).head<3>());
  }

 private:
  std::optional<solution::SupportShares> shares_{};
  std::size_t boundary_ = 0;
};

}  // namespace

Derivative derivative_of(const ObstacleForce& force, const Solved& solved) {
  const assembly::NodalCoordinates& coordinates = solved.discrete.coordinates;
  std::vector<WeightedMultiplier> all;
  for (const assembly::ContactRow& row : coordinates.rows) {
    if (!is_active(row, solved)) continue;
    const auto k = static_cast<std::size_t>(row.obstacle);
    if (force.obstacle && *force.obstacle != k) continue;
    all.push_back({coordinates.at(row.node, row.coordinate), coordinates.gaps[k][row.node].normal / row.scale});
  }
  Derivative result = weigh(all, force.component, solved);
  result.obstacle = force.obstacle;
  return result;
}

// The force of a support is the multiplier of a prescribed coordinate without the obstacles' forces on that
// coordinate.
Derivative derivative_of(const SupportForce& force, const Solved& solved) {
  const assembly::NodalCoordinates& coordinates = solved.discrete.coordinates;
  const auto owned = static_cast<std::size_t>(solved.discrete.space().layout->owned);
  const Counted counted(force, solved.discrete);
  std::vector<WeightedMultiplier> all;
  for (std::size_t i = 0; i < owned; ++i) {
    if (coordinates.tied[i]) continue;
    for (int k = 0; k < coordinates.width; ++k) {
      const auto direction = coordinates.direction(i, k);
      if (direction.isZero(0) || !coordinates.is_prescribed(i, k)) continue;
      const Vector3d d = counted(i, direction);
      if (d.isZero(0)) continue;
      all.push_back({coordinates.at(i, k), d});
      for (const assembly::ContactRow& row : coordinates.rows_of(i)) {
        if (!is_active(row, solved)) continue;
        const obstacle::Gap& gap = coordinates.gaps[static_cast<std::size_t>(row.obstacle)][i];
        const Vector3d turned = geometry::tangential(gap.normal, solved.discrete.points[i].a3);
        const double shared = direction.head<3>().dot(gap.normal) + gap.z * direction.tail<3>().dot(turned);
        all.push_back({coordinates.at(i, row.coordinate), -shared / row.scale * d});
      }
    }
  }
  Derivative result = weigh(all, force.component, solved);
  // Reactions belong to supports, not to obstacles.
  result.force_direction.setZero();
  return result;
}

}  // namespace plastron::estimation

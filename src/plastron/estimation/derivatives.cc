#include <plastron/estimation/derivatives.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/solution/support_shares.hpp>
#include <plastron/zones/contact_zones.hpp>

#include <algorithm>
#include <numeric>

namespace plastron::estimation {

namespace {

using Eigen::Vector3d;

/// Transforms nodal forces to a load of dual problems.
algebra::Vector dual_load(algebra::Vector forces, const Solved& solved) {
  algebra::Vector load(solved.box.load.layout(), solved.box.load.block());
  solved.discrete.coordinates.add_transposed(forces, load);
  return load;
}

/// The energy. With small rotations, 1/2 a(U, U): its own strain errors, and the reactions weighted with the values of fixed
/// coordinates. With finite rotations or initial strains, W(U): the dual of the forces of its stresses.
Derivative derivative_of(const Energy& /*energy*/, const Solved& solved) {
  Derivative result = zero_derivative(solved);
  const assembly::DiscreteShell& discrete = solved.discrete;
  result.value = discrete.energies(solved.nodal.y).total();
  if (!discrete.has_linear_strains() || discrete.shell.sections().have_initial_strains() ||
      discrete.obstacles.on_bed()) {
    result.dual.load = dual_load(forces_of_energy(discrete, solved.nodal.y), solved);
    result.energy_part = -1;
    return result;
  }
  result.energy_part = 1;
  for (std::size_t i = 0; i < solved.z.activity.size(); ++i)
    if (solved.z.activity[i] != contact::Activity::free) result.dual.fixed.owned()[i] = -solved.z.z.owned()[i];
  result.weighs_gaps = true;
  return result;
}

Derivative derivative_of(const LoadWork& /*work*/, const Solved& solved) {
  Derivative result = zero_derivative(solved);
  result.value = algebra::dot(solved.discrete.load, solved.nodal.y);
  result.dual.load = dual_load(solved.discrete.load, solved);
  return result;
}

Derivative derivative_of(const ContactArea& area, const Solved& solved) {
  Derivative result = zero_derivative(solved);
  const std::vector<double> areas = zones::contact_areas(solved.discrete, solved.nodal);
  result.value = area.obstacle ? areas[*area.obstacle] : std::accumulate(areas.begin(), areas.end(), 0.0);
  return result;
}

Derivative derivative_of(const ObstaclePosition& position, const Solved& solved) {
  Derivative result = zero_derivative(solved);
  result.value = solved.discrete.positions()[position.obstacle];
  const auto pressed = assembly::pressed_obstacles(solved.discrete);
  result.dual.positions.assign(pressed.size(), 0);
  const auto found = std::ranges::find(pressed, position.obstacle);
  if (found != pressed.end()) result.dual.positions[static_cast<std::size_t>(found - pressed.begin())] = 1;
  return result;
}

/// Weight of a fixed coordinate's multiplier in a force.
struct WeightedMultiplier {
  std::size_t unknown;
  Vector3d weight;
};

/// A component of the sum of weight times multiplier, or the norm of the sum. The dual is fixed at minus the weights.
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
  Derivative result = zero_derivative(solved);
  result.value = direction.dot(force);
  for (const WeightedMultiplier& m : all) result.dual.fixed.owned()[m.unknown] -= direction.dot(m.weight);
  result.force_direction = direction;
  return result;
}

bool is_active(const assembly::ContactRow& row, const Solved& solved) {
  if (!row.binds) return false;
  return solved.z.activity[solved.discrete.coordinates.at(row.node, row.coordinate)] == bound_of(row);
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
    if (solved.discrete.space().continuity.constrains(i)) continue;
    for (int k = 0; k < coordinates.width; ++k) {
      const auto direction = coordinates.direction(i, k);
      if (direction.isZero(0) || !coordinates.is_prescribed(i, k)) continue;
      const Vector3d d = counted(i, direction);
      if (d.isZero(0)) continue;
      all.push_back({coordinates.at(i, k), d});
      for (const assembly::ContactRow& row : coordinates.rows_of(i)) {
        if (!is_active(row, solved)) continue;
        const obstacle::Gap& gap = coordinates.gaps[static_cast<std::size_t>(row.obstacle)][i];
        const Vector3d turned = geometry::tangential(gap.normal, solved.discrete.place(i).a3);
        const double shared = direction.head<3>().dot(gap.normal) + gap.arm * direction.tail<3>().dot(turned);
        all.push_back({coordinates.at(i, row.coordinate), -shared / row.scale * d});
      }
    }
  }
  Derivative result = weigh(all, force.component, solved);
  // Reactions belong to supports, not to obstacles.
  result.force_direction.setZero();
  return result;
}

}  // namespace

const std::shared_ptr<const recovery::ResultantPatches>& Solved::recovered() const {
  if (!patches) patches = std::make_shared<const recovery::ResultantPatches>(discrete, nodal);
  return patches;
}

Derivative zero_derivative(const Solved& solved) {
  const algebra::Vector none(solved.box.load.layout(), solved.box.load.block());
  return {.dual = {.load = none, .fixed = none}};
}

Derivative derivative(const Functional& functional, const Solved& solved) {
  return std::visit([&](const auto& f) { return derivative_of(f, solved); }, functional);
}

std::vector<double> values(std::span<const Goal> goals, const Solved& solved) {
  std::vector<double> result;
  for (const Goal& goal : goals) result.push_back(derivative(goal.functional, solved).value);
  return result;
}

}  // namespace plastron::estimation

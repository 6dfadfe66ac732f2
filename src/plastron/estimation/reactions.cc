#include <plastron/estimation/reactions.hpp>

#include <plastron/fem/reference_cell.hpp>

#include <algorithm>

namespace plastron::estimation {

namespace {

using Eigen::Vector3d;

/// How a multiplier of a held coordinate enters a force.
struct WeightedMultiplier {
  std::size_t unknown;
  Vector3d weight;
};

/// A component of the sum of weight times multiplier, or its norm.
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

/// Marks of the local nodes on a boundary.
std::vector<char> nodes_on(const fem::Space& space, const std::string& boundary) {
  algebra::Vector marks(space.layout, 1);
  for (const fem::BoundarySide& side : space.sides) {
    if (side.cell >= space.owned_cells || side.boundary < 0) continue;
    if (space.coarse->boundaries[static_cast<std::size_t>(side.boundary)] != boundary) continue;
    for (const int node : fem::side_nodes(space.shape(), space.degree, side.side))
      marks.local()[static_cast<std::size_t>(space.nodes(side.cell)[static_cast<std::size_t>(node)])] = 1;
  }
  marks.accumulate_ghosts();
  std::vector<char> result(marks.owned().size());
  std::ranges::transform(marks.owned(), result.begin(), [](double mark) { return mark > 0; });
  return result;
}

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

// A support carries what the multiplier of a prescribed coordinate says, without what the obstacles do to that coordinate.
Derivative derivative_of(const SupportForce& force, const Solved& solved) {
  const assembly::NodalCoordinates& coordinates = solved.discrete.coordinates;
  const fem::Space& space = solved.discrete.space();
  const auto owned = static_cast<std::size_t>(space.layout->owned);
  const std::vector<char> on = force.boundary ? nodes_on(space, *force.boundary) : std::vector<char>(owned, 1);
  std::vector<WeightedMultiplier> all;
  for (std::size_t i = 0; i < owned; ++i) {
    if (!on[i] || coordinates.tied[i]) continue;
    for (int k = 0; k < coordinates.width; ++k) {
      const auto direction = coordinates.direction(i, k);
      if (direction.isZero(0) || !coordinates.is_prescribed(i, k)) continue;
      const Vector3d d = direction.head<3>();
      all.push_back({coordinates.at(i, k), d});
      for (const assembly::ContactRow& row : coordinates.rows_of(i)) {
        if (!is_active(row, solved)) continue;
        const obstacle::Gap& gap = coordinates.gaps[static_cast<std::size_t>(row.obstacle)][i];
        const Vector3d turned = geometry::tangential(gap.normal, solved.discrete.points[i].a3);
        const double shared = d.dot(gap.normal) + gap.z * direction.tail<3>().dot(turned);
        all.push_back({coordinates.at(i, row.coordinate), -shared / row.scale * d});
      }
    }
  }
  Derivative result = weigh(all, force.component, solved);
  result.force_direction.setZero();  // of supports, not of obstacles
  return result;
}

}  // namespace plastron::estimation

#include <plastron/assembly/pressing.hpp>

namespace plastron::assembly {

namespace {

/// Returns the decrease of a row's gap for a unit motion of its obstacle along the force.
double closing(const DiscreteShell& discrete, const ContactRow& row) {
  const auto k = static_cast<std::size_t>(row.obstacle);
  return discrete.coordinates.gaps[k][row.node].normal.dot(discrete.obstacles.all[k].force.normalized());
}

}  // namespace

std::vector<std::size_t> pressed_obstacles(const DiscreteShell& discrete) {
  std::vector<std::size_t> pressed;
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k)
    if (discrete.obstacles.all[k].is_pressed() && discrete.state.force_factor(k) > 0) pressed.push_back(k);
  return pressed;
}

std::vector<contact::PressingForce> pressing_forces(const DiscreteShell& discrete) {
  const NodalCoordinates& coordinates = discrete.coordinates;
  std::vector<contact::PressingForce> forces;
  for (const std::size_t k : pressed_obstacles(discrete)) {
    const algebra::Vector zero(coordinates.lower.layout(), coordinates.width);
    forces.push_back({.lower_shape = zero,
                      .upper_shape = zero,
                      .force = discrete.state.force_factor(k) * discrete.obstacles.all[k].force.norm()});
    for (const ContactRow& row : coordinates.rows) {
      if (!row.binds || static_cast<std::size_t>(row.obstacle) != k) continue;
      algebra::Vector& shape = row.scale > 0 ? forces.back().lower_shape : forces.back().upper_shape;
      shape.owned()[coordinates.at(row.node, row.coordinate)] = closing(discrete, row) / row.scale;
    }
  }
  return forces;
}

void press(DiscreteShell& discrete, std::span<const double> ways) {
  NodalCoordinates& coordinates = discrete.coordinates;
  std::vector<double> way(discrete.obstacles.all.size(), 0);
  const auto pressed = pressed_obstacles(discrete);
  PLASTRON_ASSERT(ways.size() == pressed.size(), ways.size(), pressed.size());
  for (std::size_t j = 0; j < pressed.size(); ++j) way[pressed[j]] = ways[j];
  for (ContactRow& row : coordinates.rows) {
    const double closed = way[static_cast<std::size_t>(row.obstacle)] * closing(discrete, row);
    if (closed == 0) continue;
    row.bound_gap -= closed;
    if (!row.binds) continue;
    algebra::Vector& bounds = row.scale > 0 ? coordinates.lower : coordinates.upper;
    bounds.owned()[coordinates.at(row.node, row.coordinate)] = -row.bound_gap / row.scale;
  }
  coordinates.lower.update_ghosts();
  coordinates.upper.update_ghosts();
  for (const std::size_t k : pressed) {
    const Vector3d by = way[k] * discrete.obstacles.all[k].force.normalized();
    discrete.obstacles.moved[k] += by;
    for (obstacle::Gap& gap : coordinates.gaps[k]) gap.initial -= gap.normal.dot(by);
  }
}

}  // namespace plastron::assembly

#include <plastron/assembly/discrete_shell.hpp>

#include <plastron/assembly/normal_rotation.hpp>
#include <plastron/geometry/frame.hpp>

#include <algorithm>

namespace plastron::assembly {

RigidObstacles RigidObstacles::standing(const State& state) const {
  RigidObstacles result{
      .moved = std::vector<Vector3d>(all.size(), Vector3d::Zero()), .face_scale = face_scale, .are_linear = are_linear};
  for (std::size_t k = 0; k < all.size(); ++k) result.all.push_back(all[k].standing(state.time, state.position(k)));
  return result;
}

std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description, State state) {
  ShellOperator shell(std::move(space), std::move(surface), description.sections, description.tying,
                      description.tangency.formulation == element::Formulation::classical);
  auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), description.sections);
  auto load = load_vector(shell, description.loads);
  auto discrete = std::make_unique<DiscreteShell>(DiscreteShell{.shell = std::move(shell),
                                                                .points = std::move(points),
                                                                .full_load = std::move(load),
                                                                .obstacles_at_start = description.obstacles,
                                                                .tangency = description.tangency,
                                                                .supports = description.supports});
  linearise(*discrete, std::move(state));
  return discrete;
}

void linearise(DiscreteShell& discrete, State state) {
  discrete.state = std::move(state);
  discrete.obstacles = discrete.obstacles_at_start.standing(discrete.state);
  discrete.coordinates =
      nodal_coordinates(discrete.shell.space_pointer(), discrete.points,
                        node_supports(discrete.space(), discrete.shell.surface(), discrete.points, discrete.supports),
                        discrete.obstacles, discrete.tangency.formulation, discrete.state);
  discrete.load = discrete.full_load;
  for (double& value : discrete.load.local()) value *= discrete.state.load_factor;
}

element::CellField DiscreteShell::state_values(std::size_t cell, const element::BasisAt& at) const {
  if (!state.is_deformed()) return element::CellField::Zero(static_cast<Eigen::Index>(at.xi.size()), 6);
  return shell.interpolation().values(cell, at, shell.gather(cell, state.displacement));
}

std::vector<Eigen::Vector2d> DiscreteShell::support_points() const {
  std::vector<Eigen::Vector2d> fixed;
  for (const Support& support : supports)
    if (support.point && std::ranges::find(fixed, *support.point) == fixed.end()) fixed.push_back(*support.point);
  return fixed;
}

double DiscreteShell::nodal_gap(std::size_t k, std::size_t node, const algebra::Vector& y) const {
  const Vector6 moved = node_values(y, node);
  return coordinates.gaps[k][node](moved.head<3>(), geometry::tangential(moved.tail<3>(), points[node].a3));
}

double DiscreteShell::way_pressed(std::size_t k) const {
  const obstacle::Obstacle& obstacle = obstacles.all[k];
  return obstacle.is_pressed() ? obstacles.way(k).dot(obstacle.force.normalized()) : 0;
}

std::vector<double> DiscreteShell::positions() const {
  std::vector<double> all;
  for (std::size_t k = 0; k < obstacles.all.size(); ++k) all.push_back(state.position(k) + way_pressed(k));
  return all;
}

double DiscreteShell::tangency_factor() const {
  if (tangency.formulation == element::Formulation::penalised) return 1 / tangency.penalty;
  return tangency.formulation == element::Formulation::mixed ? tangency.stabilisation : 0;
}

void DiscreteShell::apply(const algebra::Vector& y, algebra::Vector& f) const {
  PLASTRON_ASSERT(algebra::ghosts_are_current(y), "update_ghosts() before apply()");
  f.fill(0);
  shell.add_product(y, f);
  if (tangency_factor() > 0) add_normal_rotation_form(shell, tangency_factor(), y, f);
  f.accumulate_ghosts();
}

void DiscreteShell::residual(const algebra::Vector& y, algebra::Vector& f) const {
  apply(y, f);
  algebra::axpy(-1, load, f);
}

}  // namespace plastron::assembly

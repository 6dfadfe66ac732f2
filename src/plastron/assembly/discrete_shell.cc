#include <plastron/assembly/discrete_shell.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/assembly/deformed.hpp>
#include <plastron/assembly/follower_pressure.hpp>
#include <plastron/assembly/normal_rotation.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/geometry/frame.hpp>

#include <algorithm>

namespace plastron::assembly {

RigidObstacles RigidObstacles::standing(const State& state) const {
  RigidObstacles result{
      .moved = std::vector<Vector3d>(all.size(), Vector3d::Zero()), .face_scale = face_scale, .are_linear = are_linear};
  for (std::size_t k = 0; k < all.size(); ++k)
    result.all.push_back(all[k].standing(state.factors.time, state.position(k)));
  return result;
}

namespace {

/// Returns (phi, a_3) of the nodes; block 6.
algebra::Vector places_and_directors(const fem::Space& space, const std::vector<NodalPoint>& points) {
  algebra::Vector all(space.layout, 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Map<Vector3d>{all.at(i).data()} = points[i].phi;
    Eigen::Map<Vector3d>{all.at(i).data() + 3} = points[i].a3;
  }
  space.continuity.apply(all);
  return all;
}

}  // namespace

std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description, State state) {
  ShellOperator shell(std::move(space), std::move(surface), description.sections, description.tying,
                      description.tangency.formulation == element::Formulation::classical);
  auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), description.sections);
  if (description.is_objective) shell.interpolate_reference(places_and_directors(shell.space(), points));
  auto load = load_vector(shell, description.loads);
  auto follower = algebra::in_agreement<LoadError>(shell.space().layout->comm,
                                                   [&] { return follower_pressure(shell, description.loads); });
  auto discrete = std::make_unique<DiscreteShell>(DiscreteShell{.shell = std::move(shell),
                                                                .points = std::move(points),
                                                                .full_load = std::move(load),
                                                                .obstacles_at_start = description.obstacles,
                                                                .tangency = description.tangency,
                                                                .supports = description.supports,
                                                                .rotations = description.rotations,
                                                                .follower_pressure = std::move(follower)});
  linearise(*discrete, std::move(state));
  return discrete;
}

namespace {

/// Removes the rows that hold nodes of rigid bodies from the supports of a deformed shell. They were compared with the bodies at the
/// undeformed shell. Away from it the linear motion of a body and its nodes differ at second order.
void leave_to_bodies(const fem::Space& space, std::vector<NodeSupport>& supports) {
  for (const fem::PlacedBody& placed : space.bodies)
    for (const fem::BodyNode& member : placed.members) {
      if (member.node >= space.layout->owned) continue;
      NodeSupport& support = supports[static_cast<std::size_t>(member.node)];
      support.displacement.clear();
      if (placed.body.turns_normals) support.rotation.clear();
    }
}

/// Adds what depends on the state with finite rotations: places of nodes and bodies, coordinates of increments, loads on bodies.
void linearise_deformed(DiscreteShell& discrete, std::shared_ptr<const fem::Space> space,
                        std::vector<NodeSupport> supports) {
  State increments = discrete.state;
  increments.displacement = {};
  algebra::Vector& y = discrete.state.displacement;
  if (discrete.state.is_deformed() && algebra::max_abs(y) > 0) leave_to_bodies(*space, supports);
  y = discrete.state.is_deformed() ? with_kept_lengths(discrete.space(), discrete.points, std::move(y))
                                   : algebra::Vector(discrete.space().layout, 6);
  discrete.moved = moved_points(discrete.points, y);
  discrete.places = body_places(discrete.space(), discrete.points, y);
  space = turned_space(space, discrete.points, discrete.moved, discrete.places);
  turn_body_loads(discrete.space(), *space, discrete.unit_load);
  if (!discrete.follower_pressure.empty())
    algebra::axpy(1, change_of_follower_forces(discrete.shell, discrete.follower_pressure, y), discrete.unit_load);
  algebra::axpy(-1, initial_forces(discrete.shell), discrete.unit_load);  // part of stresses()
  discrete.coordinates =
      nodal_coordinates(std::move(space), discrete.moved, remaining_supports(std::move(supports), discrete.points, y),
                        discrete.obstacles, element::Formulation::tangent, increments);
}

}  // namespace

void linearise(DiscreteShell& discrete, State state) {
  discrete.state = std::move(state);
  discrete.obstacles = discrete.obstacles_at_start.standing(discrete.state);
  discrete.unit_load = discrete.full_load;
  const double part = discrete.state.factors.supports;
  auto space = fem::with_part_of_motions(discrete.shell.space_pointer(), part);
  auto supports = node_supports(*space, discrete.shell.surface(), discrete.points, discrete.supports);
  for (NodeSupport& support : supports)
    for (auto* rows : {&support.displacement, &support.rotation})
      for (auto& [direction, value] : *rows) value *= part;
  if (discrete.has_finite_rotations())
    linearise_deformed(discrete, std::move(space), std::move(supports));
  else
    discrete.coordinates = nodal_coordinates(std::move(space), discrete.points, supports, discrete.obstacles,
                                             discrete.tangency.formulation, discrete.state);
  discrete.load = discrete.unit_load;
  for (double& value : discrete.load.local()) value *= discrete.state.factors.loads;
}

std::optional<element::CellField> DiscreteShell::linearised_at(FieldKind kind, std::size_t cell,
                                                               const element::CellField& field) const {
  if (!has_finite_rotations()) return {};
  if (kind == FieldKind::solution) return field / 2;  // see ShellOperator::finite_strains()
  return shell.gather(cell, state.displacement);
}

CellGeometry DiscreteShell::geometry(std::size_t cell) const {
  return has_finite_rotations() ? shell.geometry(cell, shell.gather(cell, state.displacement)) : shell.geometry(cell);
}

CellStrain DiscreteShell::strains(std::size_t cell, const algebra::Vector& y) const {
  const element::CellField field = shell.gather(cell, y);
  return has_finite_rotations() ? shell.finite_strains(cell, field) : shell.strains(cell, field);
}

CellStrain DiscreteShell::stresses(std::size_t cell, const CellStrain& strains) const {
  CellStrain stresses = shell.weighted_stresses(cell, strains);
  if (const auto initial = shell.weighted_initial_stresses(cell)) stresses -= state.factors.loads * *initial;
  return stresses;
}

Energies DiscreteShell::energies(const algebra::Vector& y) const {
  if (!has_finite_rotations()) return shell.energies(y);
  return shell.energies_of([&](std::size_t cell) { return strains(cell, y); });
}

Energies DiscreteShell::motion_energies(const algebra::Vector& y) const {
  if (!has_finite_rotations()) return shell.energies(y);
  return shell.energies_of(
      [&](std::size_t cell) { return shell.strains(cell, shell.gather(cell, y), geometry(cell)); });
}

obstacle::ShellPoint DiscreteShell::shell_point(const Vector3d& phi, const Vector3d& a3, double thickness,
                                                const Vector6& motion) const {
  if (has_finite_rotations()) return {phi, a3, thickness, motion.head<3>(), motion.tail<3>(), true};
  return assembly::shell_point(phi, a3, thickness, motion);
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
  const Vector6 now = in_coordinates(y, node);
  return coordinates.gaps[k][node](now.head<3>(), geometry::tangential(now.tail<3>(), place(node).a3));
}

Vector3d DiscreteShell::touching_place(std::size_t k, std::size_t node) const {
  const obstacle::Gap& gap = coordinates.gaps[k][node];
  return has_finite_rotations() ? Vector3d(points[node].phi + gap.z * points[node].a3) : gap.contact_point;
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
  PLASTRON_ASSERT(!has_finite_rotations());
  f.fill(0);
  shell.add_product(y, f);
  if (tangency_factor() > 0) add_normal_rotation_form(shell, tangency_factor(), y, f);
  f.accumulate_ghosts();
}

void DiscreteShell::residual(const algebra::Vector& y, algebra::Vector& f) const {
  if (has_finite_rotations())
    f = forces_of_stresses(
        shell, [&](std::size_t c) { return stresses(c, strains(c, y)); },
        [&](std::size_t c) { return shell.geometry(c, shell.gather(c, y)); });
  else
    apply(y, f);
  algebra::axpy(-1, load, f);
}

algebra::Vector loads_and_initial_forces(const DiscreteShell& discrete) {
  algebra::Vector loads = discrete.load;
  if (discrete.has_finite_rotations())
    algebra::axpy(discrete.state.factors.loads, initial_forces(discrete.shell), loads);
  return loads;
}

algebra::Vector load_rate(const DiscreteShell& discrete) {
  const ShellOperator& shell = discrete.shell;
  algebra::Vector rate = forces_of_stresses(
      shell,
      [&](std::size_t c) {
        const auto initial = shell.weighted_initial_stresses(c);
        return initial ? *initial : CellStrain(CellStrain::Zero(shell.tables().points_per_cell(), 8));
      },
      [&](std::size_t c) { return discrete.geometry(c); });
  algebra::axpy(1, discrete.unit_load, rate);
  return rate;
}

algebra::Vector forces_of_energy(const DiscreteShell& discrete, const algebra::Vector& y) {
  const ShellOperator& shell = discrete.shell;
  return forces_of_stresses(
      shell, [&](std::size_t c) { return shell.weighted_stresses(c, discrete.strains(c, y)); },
      [&](std::size_t c) { return shell.geometry(c, shell.gather(c, y)); });
}

}  // namespace plastron::assembly

#include <plastron/assembly/discrete_shell.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/assembly/deformed.hpp>
#include <plastron/energy/follower_pressure.hpp>
#include <plastron/energy/hinge.hpp>
#include <plastron/energy/normal_rotation.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/geometry/rotation.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace plastron::assembly {

using Eigen::Matrix3d;

RigidObstacles RigidObstacles::standing(const State& state) const {
  RigidObstacles result{
      .moved = std::vector<Vector3d>(all.size(), Vector3d::Zero()), .face_scale = face_scale, .are_linear = are_linear};
  for (std::size_t k = 0; k < all.size(); ++k)
    result.all.push_back(all[k].standing(state.factors.time, state.position(k)));
  return result;
}

namespace {

/// Returns the factor of the form of normal_rotation.hpp: 1/p (M13), rho (M14) or zero.
double tangency_factor(const element::Tangency& tangency) {
  if (tangency.formulation == element::Formulation::penalised) return 1 / tangency.penalty;
  return tangency.formulation == element::Formulation::mixed ? tangency.stabilisation : 0;
}

}  // namespace

std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description, State state) {
  energy::ShellOperator shell(std::move(space), std::move(surface), description.sections, description.tying,
                              description.tangency.formulation == element::Formulation::classical);
  auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), description.sections);
  if (description.is_objective) shell.interpolate_reference(places_and_directors(shell.space(), points));
  auto loads = energy::load_parts(shell, description.loads);
  std::vector<std::pair<energy::Foundation, std::shared_ptr<const energy::Term>>> foundations;
  for (const energy::Foundation& foundation : description.foundations) foundations.emplace_back(foundation, nullptr);
  auto discrete = std::make_unique<DiscreteShell>(DiscreteShell{.shell = std::move(shell),
                                                                .points = std::move(points),
                                                                .loads = std::move(loads),
                                                                .foundations = std::move(foundations),
                                                                .obstacles_at_start = description.obstacles,
                                                                .tangency = description.tangency,
                                                                .all_supports = description.supports});
  discrete->set_rotations(description.rotations);
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
  discrete.places = body_places(discrete.space(), y);
  space = turned_space(space, discrete.points, discrete.moved, discrete.places);
  discrete.coordinates =
      nodal_coordinates(std::move(space), discrete.moved, remaining_supports(std::move(supports), discrete.points, y),
                        discrete.obstacles, element::Formulation::tangent, increments);
}

/// Returns the forces of all loads at the state, with these factors (collective).
algebra::Vector forces_of_loads(const DiscreteShell& discrete, const energy::Factors& factors) {
  algebra::Vector sum(discrete.space().layout, 6);
  for (const energy::LoadPart& part : discrete.loads) {
    const double factor = factors.load(part.factor);
    algebra::axpy(factor, part.forces, sum);
    if (discrete.has_finite_rotations() && part.follows)
      algebra::axpy(factor, change_of_follower_forces(discrete.shell, part.pressure, discrete.state.displacement), sum);
  }
  if (discrete.has_finite_rotations()) turn_body_loads(discrete.space(), *discrete.coordinates.space, factors, sum);
  return sum;
}

}  // namespace

void linearise(DiscreteShell& discrete, State state) {
  discrete.state = std::move(state);
  discrete.obstacles = discrete.obstacles_at_start.standing(discrete.state);
  const energy::Factors& factors = discrete.state.factors;
  discrete.supports.clear();
  std::ranges::copy_if(discrete.all_supports, std::back_inserter(discrete.supports),
                       [&](const Support& support) { return !factors.is_released(support.factor); });
  auto space = fem::with_part_of_motions(discrete.shell.space_pointer(),
                                         [&](const fem::RigidBody& body) { return factors.support(body.factor); });
  auto supports = node_supports(*space, discrete.shell.surface(), discrete.points, discrete.supports, factors);
  if (discrete.has_finite_rotations())
    linearise_deformed(discrete, std::move(space), std::move(supports));
  else
    discrete.coordinates = nodal_coordinates(std::move(space), discrete.points, supports, discrete.obstacles,
                                             discrete.tangency.formulation, discrete.state);
  discrete.load = forces_of_loads(discrete, factors);
  discrete.initial_forces = energy::initial_forces(discrete.shell, factors);
}

void DiscreteShell::set_rotations(element::Rotations model) {
  rotations = model;
  terms.clear();
  if (const double factor = tangency_factor(tangency); factor > 0)
    terms.push_back(energy::normal_rotation_term(factor));
  for (auto& [foundation, term] : foundations) {
    term = energy::foundation_term(shell, foundation, rotations);
    if (term) terms.push_back(term);
  }
  if (auto hinges = energy::hinge_term(space(), places_and_directors(space(), points), rotations))
    terms.push_back(std::move(hinges));
}

std::optional<element::CellField> DiscreteShell::linearised_at(FieldKind kind, std::size_t cell,
                                                               const element::CellField& field) const {
  if (!has_finite_rotations()) return {};
  if (kind == FieldKind::solution) return field / 2;  // see ShellOperator::finite_strains()
  return shell.gather(cell, state.displacement);
}

double DiscreteShell::angle(const Vector3d& a3, const Vector3d& r) const {
  return has_finite_rotations() ? 2 * std::asin(std::min(1.0, r.norm() / (2 * a3.norm()))) : r.norm();
}

fem::BodyMotion DiscreteShell::body_motion(std::size_t body, const algebra::Vector& y) const {
  if (!has_finite_rotations()) return fem::motion_of(*coordinates.space, coordinates.space->bodies[body], y);
  const fem::RigidBody& description = space().bodies[body].body;
  const Vector3d prescribed = state.factors.support(description.factor) * description.prescribed_rotation();
  return {places[body].displacement, geometry::rotation_vector(places[body].turn, prescribed)};
}

Vector6 DiscreteShell::carried(std::size_t body, const fem::BodyNode& member, const fem::BodyMotion& motion) const {
  const fem::PlacedBody& placed = space().bodies[body];
  Vector6 values;
  if (!has_finite_rotations()) {
    values << motion.displacement, placed.length * motion.rotation;
    return member.motion * values;
  }
  const NodalPoint& point = points[static_cast<std::size_t>(member.node)];
  const Matrix3d change = places[body].turn - Matrix3d::Identity();
  values << places[body].displacement + change * (point.phi - placed.body.reference), change * point.a3;
  return values;
}

Vector3d DiscreteShell::reference_of_body(std::size_t body) const {
  const Vector3d& reference = space().bodies[body].body.reference;
  return has_finite_rotations() ? Vector3d(reference + places[body].displacement) : reference;
}

energy::CellGeometry DiscreteShell::geometry(std::size_t cell) const {
  return has_finite_rotations() ? shell.geometry(cell, shell.gather(cell, state.displacement)) : shell.geometry(cell);
}

energy::CellStrain DiscreteShell::strains(std::size_t cell, const algebra::Vector& y) const {
  const element::CellField field = shell.gather(cell, y);
  return has_finite_rotations() ? shell.finite_strains(cell, field) : shell.strains(cell, field);
}

energy::CellStrain DiscreteShell::stresses(std::size_t cell, const energy::CellStrain& strains) const {
  energy::CellStrain stresses = shell.weighted_stresses(cell, strains);
  if (const auto initial = shell.weighted_initial_stresses(cell, state.factors)) stresses -= *initial;
  return stresses;
}

energy::Energies DiscreteShell::energies(const algebra::Vector& y) const {
  if (!has_finite_rotations() && !shell.sections().have_initial_strains()) return motion_energies(y);
  return energies_of([&](std::size_t cell) { return strains(cell, y); }, y);
}

energy::Energies DiscreteShell::energies_of(const std::function<energy::CellStrain(std::size_t)>& strains_at,
                                            const algebra::Vector& y) const {
  energy::Energies energies = shell.energies_of([&](std::size_t cell) {
    energy::CellStrain elastic = strains_at(cell);
    if (const auto initial = shell.initial_strains(cell, state.factors)) elastic -= *initial;
    return elastic;
  });
  energies.foundations = energy_of_terms(y, false);
  return energies;
}

energy::Energies DiscreteShell::motion_energies(const algebra::Vector& y) const {
  energy::Energies energies = has_finite_rotations() ? shell.energies_of([&](std::size_t cell) {
    return shell.strains(cell, shell.gather(cell, y), geometry(cell));
  })
                                                     : shell.energies(y);
  algebra::Vector forces(y.layout(), 6);
  for (const auto& term : terms)
    if (!term->is_artificial()) term->add_product(shell, state.displacement, y, forces);
  forces.accumulate_ghosts();
  energies.foundations = algebra::dot(forces, y) / 2;
  return energies;
}

bool DiscreteShell::has_follower_pressure() const { return std::ranges::any_of(loads, &energy::LoadPart::follows); }

Eigen::VectorXd DiscreteShell::follower_pressure(std::size_t cell) const {
  Eigen::VectorXd sum;
  if (!has_finite_rotations()) return sum;
  for (const energy::LoadPart& part : loads) {
    if (part.pressure.empty() || part.pressure[cell].size() == 0) continue;
    const Eigen::VectorXd own = state.factors.load(part.factor) * part.pressure[cell];
    sum = sum.size() == 0 ? own : Eigen::VectorXd(sum + own);
  }
  return sum;
}

double DiscreteShell::energy_of_terms(const algebra::Vector& y, bool are_artificial) const {
  double sum = 0;
  for (const auto& term : terms)
    if (term->is_artificial() == are_artificial) sum += term->energy(shell, y);
  return sum;
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

void DiscreteShell::apply(const algebra::Vector& y, algebra::Vector& f) const {
  PLASTRON_ASSERT(algebra::ghosts_are_current(y), "update_ghosts() before apply()");
  PLASTRON_ASSERT(!has_finite_rotations());
  f.fill(0);
  shell.add_product(y, f);
  for (const auto& term : terms) term->add_forces(shell, y, f);
  f.accumulate_ghosts();
}

void DiscreteShell::residual(const algebra::Vector& y, algebra::Vector& f) const {
  f = forces_of_energy(*this, y);
  algebra::axpy(-1, load, f);
}

algebra::Vector forces_of_terms(const DiscreteShell& discrete, const algebra::Vector& y, bool are_on_bodies) {
  algebra::Vector f(y.layout(), 6);
  for (const auto& term : discrete.terms)
    if (term->is_on_body() == are_on_bodies) term->add_forces(discrete.shell, y, f);
  f.accumulate_ghosts();
  return f;
}

void add_springs(const DiscreteShell& discrete, const NodalCoordinates& coordinates, algebra::Matrix& matrix) {
  coordinates.add_bed_stiffness(matrix);
  for (const auto& term : discrete.terms)
    for (constraints::NodeColumns& own : term->stiffness_between_cells(discrete.shell, discrete.state.displacement)) {
      const constraints::NodeColumns k = on_both_sides(coordinates, own.nodes, std::move(own.matrix));
      matrix.add(k.nodes, {k.matrix.data(), static_cast<std::size_t>(k.matrix.size())});
    }
  const fem::Space& space = *coordinates.space;
  for (std::size_t k = 0; k < space.bodies.size(); ++k)
    for (const auto& term : discrete.terms) {
      const auto stiffness = term->stiffness_of_body(discrete.shell, k, discrete.state.displacement);
      if (!stiffness) continue;
      for (const int part : {0, 1}) {
        const algebra::LocalIndex host = space.bodies[k].hosts[static_cast<std::size_t>(part)];
        if (host < 0 || host >= space.layout->owned) continue;
        const RowMatrix basis =
            coordinates.basis[static_cast<std::size_t>(host)].topRows<3>().leftCols(coordinates.width);
        const RowMatrix block = basis.transpose() * stiffness->block<3, 3>(3 * part, 3 * part) * basis;
        matrix.add({&host, 1}, {block.data(), static_cast<std::size_t>(block.size())});
      }
    }
}

void add_product_of_terms(const DiscreteShell& discrete, const algebra::Vector& y, algebra::Vector& f) {
  algebra::Vector own(f.layout(), 6);
  for (const auto& term : discrete.terms) term->add_product(discrete.shell, discrete.state.displacement, y, own);
  own.accumulate_ghosts();
  algebra::axpy(1, own, f);
}

algebra::Vector loads_and_initial_forces(const DiscreteShell& discrete) {
  algebra::Vector loads = discrete.load;
  algebra::axpy(1, discrete.initial_forces, loads);
  return loads;
}

algebra::Vector load_rate(const DiscreteShell& discrete) {
  const energy::ShellOperator& shell = discrete.shell;
  const energy::Factors rates =
      discrete.state.factors.load_rates(discrete.state.control ? discrete.state.control->factor : -1);
  algebra::Vector rate = forces_of_stresses(
      shell,
      [&](std::size_t c) {
        const auto initial = shell.weighted_initial_stresses(c, rates);
        return initial ? *initial : energy::CellStrain(energy::CellStrain::Zero(shell.tables().points_per_cell(), 8));
      },
      [&](std::size_t c) { return discrete.geometry(c); });
  algebra::axpy(1, forces_of_loads(discrete, rates), rate);
  return rate;
}

algebra::Vector forces_of_energy(const DiscreteShell& discrete, const algebra::Vector& y) {
  const energy::ShellOperator& shell = discrete.shell;
  algebra::Vector f(y.layout(), 6);
  if (!discrete.has_finite_rotations()) {
    discrete.apply(y, f);
    algebra::axpy(-1, discrete.initial_forces, f);
    return f;
  }
  f = forces_of_stresses(
      shell, [&](std::size_t c) { return discrete.stresses(c, discrete.strains(c, y)); },
      [&](std::size_t c) { return shell.geometry(c, shell.gather(c, y)); });
  for (const bool are_on_bodies : {false, true}) algebra::axpy(1, forces_of_terms(discrete, y, are_on_bodies), f);
  return f;
}

}  // namespace plastron::assembly

#include <plastron/assembly/discrete_shell.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/assembly/deformed.hpp>
#include <plastron/energy/follower_pressure.hpp>
#include <plastron/energy/hinge.hpp>
#include <plastron/energy/normal_rotation.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/geometry/frame.hpp>

#include <algorithm>
#include <iterator>

namespace plastron::assembly {

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
  for (const energy::Foundation& foundation : description.foundations)
    foundations.emplace_back(foundation, energy::foundation_term(shell, foundation));
  auto discrete = std::make_unique<DiscreteShell>(DiscreteShell{.shell = std::move(shell),
                                                                .points = std::move(points),
                                                                .loads = std::move(loads),
                                                                .terms = {},
                                                                .foundations = std::move(foundations),
                                                                .obstacles_at_start = description.obstacles,
                                                                .tangency = description.tangency,
                                                                .all_supports = description.supports,
                                                                .rotations = description.rotations});
  discrete->terms = terms_of(*discrete);
  linearise(*discrete, std::move(state));
  return discrete;
}

energy::Terms terms_of(const DiscreteShell& discrete) {
  energy::Terms terms;
  if (const double factor = tangency_factor(discrete.tangency); factor > 0)
    terms.push_back(energy::normal_rotation_term(factor));
  for (const auto& [foundation, term] : discrete.foundations)
    if (term) terms.push_back(term);
  if (auto hinges = energy::hinge_term(discrete.space(), places_and_directors(discrete.space(), discrete.points),
                                       discrete.rotations))
    terms.push_back(std::move(hinges));
  return terms;
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

std::optional<element::CellField> DiscreteShell::linearised_at(FieldKind kind, std::size_t cell,
                                                               const element::CellField& field) const {
  if (!has_finite_rotations()) return {};
  if (kind == FieldKind::solution) return field / 2;  // see ShellOperator::finite_strains()
  return shell.gather(cell, state.displacement);
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
  if (!has_finite_rotations()) {
    energies.foundations = energy_of_terms(y, false);
    return energies;
  }
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

void add_forces_of_terms(const DiscreteShell& discrete, const algebra::Vector& y, algebra::Vector& f) {
  if (discrete.terms.empty()) return;
  algebra::Vector own(f.layout(), 6);
  for (const auto& term : discrete.terms) term->add_forces(discrete.shell, y, own);
  own.accumulate_ghosts();
  algebra::axpy(1, own, f);
}

void add_product_of_terms(const DiscreteShell& discrete, const algebra::Vector& y, algebra::Vector& f) {
  if (discrete.terms.empty()) return;
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
  add_forces_of_terms(discrete, y, f);
  return f;
}

}  // namespace plastron::assembly

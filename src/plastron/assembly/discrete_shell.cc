#include <plastron/assembly/discrete_shell.hpp>

#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/multiplier.hpp>
#include <plastron/assembly/pressing.hpp>
#include <plastron/assembly/stiffness.hpp>
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
      nodal_coordinates(discrete.shell.space_pointer(), discrete.shell.surface(), discrete.points, discrete.supports,
                        discrete.obstacles, discrete.tangency.formulation, discrete.state);
  discrete.load = discrete.full_load;
  for (double& value : discrete.load.local()) value *= discrete.state.load_factor;
}

element::CellField DiscreteShell::state_values(std::size_t cell, const element::BasisAt& at) const {
  if (!state.is_deformed()) return element::CellField::Zero(static_cast<Eigen::Index>(at.xi.size()), 6);
  return shell.interpolation().values(cell, at, shell.gather(cell, state.displacement));
}

std::vector<Eigen::Vector2d> DiscreteShell::support_points() const {
  std::vector<Eigen::Vector2d> held;
  for (const Support& support : supports)
    if (support.point && std::ranges::find(held, *support.point) == held.end()) held.push_back(*support.point);
  return held;
}

double DiscreteShell::nodal_gap(std::size_t k, std::size_t node, const algebra::Vector& y) const {
  const Eigen::Map<const Vector3d> u(y.local().data() + 6 * node), r(y.local().data() + 6 * node + 3);
  return coordinates.gaps[k][node](u, geometry::tangential(Vector3d(r), points[node].a3));
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

algebra::Matrix stiffness_matrix(const DiscreteShell& discrete) {
  return stiffness_matrix(discrete.shell, discrete.coordinates, discrete.tangency_factor());
}

namespace {

/// Returns the constraint b(U, q) = 0 in nodal coordinates. The Schur complement of the multiplier is spectrally close
/// to the matrix of int a^{ab} d_a p d_b q. The reason: b(s, q) is equal to this form for s = q a_3, and this s adds
/// little other energy.
contact::EqualityConstraints tangency_constraints(const DiscreteShell& discrete) {
  const auto& layout = discrete.space().layout;
  const auto zeros = std::make_shared<const std::vector<char>>(multiplier_zeros(discrete.coordinates, *layout));
  const auto clear = [zeros](algebra::Vector& q) {
    for (std::size_t i = 0; i < zeros->size(); ++i)
      if ((*zeros)[i]) q.owned()[i] = 0;
  };
  struct Gradients {
    explicit Gradients(algebra::Matrix m) : matrix(std::move(m)), factor(matrix) {}
    algebra::Matrix matrix;
    algebra::Factorisation factor;
  };
  const auto gradients = std::make_shared<Gradients>(gradient_matrix(discrete.shell));
  if (!gradients->factor.factorise(*zeros))
    throw SupportError("the mixed formulation needs r . a_3 = 0 somewhere: fix a component of r on a boundary");
  const auto y = std::make_shared<algebra::Vector>(layout, 6), spread = std::make_shared<algebra::Vector>(layout, 1);
  return {.multipliers = algebra::Vector(layout, 1),
          .apply =
              [&discrete, y, clear](const algebra::Vector& z, algebra::Vector& q) {
                discrete.coordinates.to_cartesian(z, *y);
                apply_coupling(discrete.shell, *y, q);
                clear(q);
              },
          .apply_transposed =
              [&discrete, y, spread](const algebra::Vector& q, algebra::Vector& z) {
                *spread = q;
                apply_coupling_transposed(discrete.shell, *spread, *y);
                z.fill(0);
                discrete.coordinates.add_transposed(*y, z);
              },
          .precondition = [gradients](const algebra::Vector& q, algebra::Vector& p) { gradients->factor.solve(q, p); }};
}

}  // namespace

contact::BoxProblem box_problem(const DiscreteShell& discrete, const algebra::Matrix& matrix) {
  const auto& layout = discrete.space().layout;
  algebra::Vector load(layout, discrete.coordinates.width);
  algebra::Vector forces = discrete.load;
  discrete.coordinates.add_transposed(forces, load);
  // Scratch vectors live as long as the operator because it is applied many times.
  const auto y = std::make_shared<algebra::Vector>(layout, 6), f = std::make_shared<algebra::Vector>(layout, 6);
  const auto apply = [&discrete, y, f](const algebra::Vector& z, algebra::Vector& result) {
    discrete.coordinates.to_cartesian(z, *y);
    discrete.apply(*y, *f);
    result.fill(0);
    discrete.coordinates.add_transposed(*f, result);
  };
  contact::BoxProblem problem{.matrix = matrix,
                              .apply = apply,
                              .load = std::move(load),
                              .lower = discrete.coordinates.lower,
                              .upper = discrete.coordinates.upper};
  problem.pressing = pressing_forces(discrete);
  if (discrete.tangency.formulation == element::Formulation::mixed) problem.equations = tangency_constraints(discrete);
  return problem;
}

}  // namespace plastron::assembly

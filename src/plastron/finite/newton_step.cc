#include <plastron/finite/newton_step.hpp>

#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/contact_coordinates.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <span>

namespace plastron::finite {

using assembly::ContactRow;
using assembly::NodalCoordinates;
using assembly::NodeSupport;
using Eigen::Vector3d;

namespace {

/// Where all three components of r are prescribed, they prescribe a director: replaces them by the way to it, tangential
/// to the present one. Returns whether it has done this.
bool prescribes_director(const Vector3d& a3, const Vector3d& now, NodeSupport& support) {
  constexpr double independent = 1e-6;
  Eigen::Matrix3d rows = Eigen::Matrix3d::Zero();
  Vector3d values = Vector3d::Zero();
  for (const auto& [direction, value] : support.rotation) {
    rows += direction * direction.transpose();
    values += value * direction;
  }
  if (!(geometry::symmetric_eigen(rows).values[0] > independent)) return false;
  const Vector3d way = (a3 + rows.ldlt().solve(values)).normalized() - now;
  support.rotation.clear();
  for (const Vector3d& direction : assembly::across(now)) support.rotation.emplace_back(direction, direction.dot(way));
  return true;
}

/// Returns the supports for increments: the prescribed values less the present ones.
std::vector<NodeSupport> remaining_supports(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  std::vector<NodeSupport> all =
      node_supports(discrete.space(), discrete.shell.surface(), discrete.points, discrete.supports);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const assembly::Vector6 now = assembly::node_values(y, i);
    const Vector3d& a3 = discrete.points[i].a3;
    all[i].displacement_scale = std::max(all[i].displacement_scale, discrete.points[i].thickness);
    all[i].rotation_scale = std::max(all[i].rotation_scale, 1.0);
    for (auto& [direction, value] : all[i].displacement) value -= direction.dot(now.head<3>());
    if (prescribes_director(a3, (a3 + now.tail<3>()).normalized(), all[i])) continue;
    for (auto& [direction, value] : all[i].rotation) value -= direction.dot(now.tail<3>());
  }
  return all;
}

/// Returns W (M27) of strains, without the constant of initial strains.
double energy_of(const assembly::ShellOperator& shell, std::size_t cell, const CellStrain& strains) {
  return strains.cwiseProduct(shell.weighted_stresses(cell, strains)).sum() / 2;
}

/// Sets stresses and energy of the linearised strains.
void set_stresses(const assembly::DiscreteShell& discrete, const algebra::Vector& y, const algebra::Vector& increment,
                  NewtonStep& step) {
  const assembly::ShellOperator& shell = discrete.shell;
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const element::CellField field = shell.gather(c, y);
    const CellStrain strains =
        shell.finite_strains(c, field) + shell.strains(c, shell.gather(c, increment), shell.geometry(c, field));
    step.end.stresses.push_back(stresses_of(discrete, c, strains));
    step.energy += energy_of(shell, c, strains);
  }
  step.energy = algebra::sum_over_ranks(step.energy, shell.space().layout->comm);
}

/// Sets the reactions of obstacles and the nodes in contact.
void set_reactions(const assembly::DiscreteShell& discrete, const std::vector<assembly::NodalPoint>& points,
                   const NodalCoordinates& coordinates, const contact::BoxSolution& z, NewtonStep& step) {
  const MPI_Comm comm = discrete.space().layout->comm;
  step.obstacle_forces.assign(coordinates.gaps.size(), Vector3d::Zero());
  step.end.contact_couples.assign(static_cast<std::size_t>(discrete.space().layout->owned), 0);
  step.end.touching = algebra::Vector(discrete.space().layout, std::max(1, static_cast<int>(coordinates.gaps.size())));
  for (const ContactRow& row : coordinates.rows) {
    if (!row.binds) continue;
    const std::size_t unknown = coordinates.at(row.node, row.coordinate);
    if (z.activity[unknown] != bound_of(row)) continue;
    const auto k = static_cast<std::size_t>(row.obstacle);
    const obstacle::Gap& gap = coordinates.gaps[k][row.node];
    const double force = z.multiplier.owned()[unknown] / row.scale;
    step.obstacle_forces[k] += force * gap.normal;
    step.contact_area += discrete.points[row.node].weight;
    step.end.contact_couples[row.node] += force * gap.arm * gap.normal.dot(points[row.node].a3);
    step.end.touching.at(row.node)[k] = 1;
  }
  step.end.touching.update_ghosts();
  for (Vector3d& force : step.obstacle_forces)
    for (double& component : force) component = algebra::sum_over_ranks(component, comm);
  step.contact_area = algebra::sum_over_ranks(step.contact_area, comm);
}

constexpr double least_shift = 1e-6, largest_shift = 0.3;

/// Whether the solver met a set of active bounds without a minimiser.
bool is_indefinite(contact::Status status) {
  return status == contact::Status::singular || status == contact::Status::not_held;
}

/// Returns the rotation by a vector: axis times angle [rad].
Eigen::Matrix3d rotation_by(const Vector3d& theta) {
  const double angle = theta.norm();
  return angle > 0 ? Eigen::AngleAxisd(angle, theta / angle).toRotationMatrix() : Eigen::Matrix3d::Identity();
}

/// Returns the space in which kinks and rigid bodies have turned.
std::shared_ptr<const fem::Space> turned_space(const assembly::DiscreteShell& discrete,
                                               const std::vector<assembly::NodalPoint>& points,
                                               const std::vector<BodyPlace>& bodies) {
  std::vector<Vector3d> normals, directors;
  std::vector<Eigen::Matrix3d> turns;
  normals.reserve(points.size());
  directors.reserve(points.size());
  for (const assembly::NodalPoint& point : discrete.points) normals.push_back(point.a3);
  for (const assembly::NodalPoint& point : points) directors.push_back(point.a3);
  turns.reserve(bodies.size());
  for (const BodyPlace& body : bodies) turns.push_back(body.turn);
  return fem::turned(discrete.shell.space_pointer(), normals, directors, turns);
}

/// Moves the loads on rigid bodies with them: dead forces and moments about the reference points.
void turn_body_loads(const assembly::DiscreteShell& discrete, const fem::Space& turned, algebra::Vector& forces) {
  algebra::Vector before(forces.layout(), 6), now(forces.layout(), 6);
  for (std::size_t k = 0; k < turned.bodies.size(); ++k) {
    fem::add_body_load(discrete.space(), discrete.space().bodies[k], before);
    fem::add_body_load(turned, turned.bodies[k], now);
  }
  algebra::axpy(discrete.state.load_factor, before, forces);
  algebra::axpy(-discrete.state.load_factor, now, forces);
}

double largest_rotation(const algebra::Vector& increment) {
  double largest = 0;
  for (std::size_t i = 0; i < increment.owned().size(); i += 6)
    largest = std::max(largest, Eigen::Map<const Vector3d>(increment.owned().data() + i + 3).norm());
  return algebra::max_over_ranks(largest, increment.layout()->comm);
}

BodyPlace part_of_way(double part, const BodyPlace& from, const BodyPlace& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.turn * from.turn.transpose()));
  return {from.displacement + part * (to.displacement - from.displacement),
          rotation_by(part * turn.angle() * turn.axis()) * from.turn};
}

/// Makes y = a + factor (b - a).
void interpolate(double factor, std::span<const double> a, std::span<const double> b, std::span<double> y) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = a[i] + factor * (b[i] - a[i]);
}

}  // namespace

State prestress_of_linear(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  State state{.y = algebra::Vector(discrete.space().layout, 6)};
  for (std::size_t c = 0; c < discrete.space().owned_cells; ++c)
    state.stresses.push_back(stresses_of(discrete, c, discrete.shell.strains(c, discrete.shell.gather(c, solution.y))));
  state.touching = solution.touching;
  state.positions = discrete.positions();
  state.contact_couples.assign(static_cast<std::size_t>(discrete.space().layout->owned), 0);
  for (const ContactRow& row : discrete.coordinates.rows) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    const obstacle::Gap& gap = discrete.coordinates.gaps[k][row.node];
    const assembly::NodalPoint& point = discrete.points[row.node];
    state.contact_couples[row.node] +=
        solution.pressure.at(row.node)[k] * point.weight * gap.arm * gap.normal.dot(point.a3);
  }
  return state;
}

State state_of_linear(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  State state = prestress_of_linear(discrete, solution);
  for (const fem::PlacedBody& placed : discrete.space().bodies) {
    const fem::BodyMotion motion = fem::motion_of(discrete.space(), placed, solution.y);
    state.bodies.push_back({motion.displacement, rotation_by(motion.rotation)});
  }
  state.y = with_unit_directors(discrete, solution.y, state.bodies);
  return state;
}

NewtonStep newton_step(const assembly::DiscreteShell& discrete, const State& state, const contact::Settings& settings,
                       const contact::Observer& observer) {
  const auto& layout = discrete.space().layout;
  assembly::State at = discrete.state;
  at.displacement = {};
  at.positions = state.positions;
  const assembly::RigidObstacles obstacles = discrete.obstacles_at_start.standing(at);
  const std::vector<assembly::NodalPoint> points = moved_points(discrete, state.y);
  const std::shared_ptr<const fem::Space> space = turned_space(discrete, points, state.bodies);
  const NodalCoordinates coordinates = nodal_coordinates(space, points, remaining_supports(discrete, state.y),
                                                         obstacles, element::Formulation::tangent, at);
  const algebra::Matrix matrix = tangent_matrix(discrete, state, points, coordinates);
  algebra::Vector forces = unbalanced_forces(discrete, state.y), load(layout, coordinates.width);
  turn_body_loads(discrete, *space, forces);
  coordinates.add_transposed(forces, load);
  for (double& value : load.local()) value = -value;
  const algebra::Vector diagonal = matrix.diagonal();
  contact::BoxProblem box{.matrix = matrix,
                          .apply = {},
                          .load = std::move(load),
                          .lower = coordinates.lower,
                          .upper = coordinates.upper,
                          .may_be_indefinite = true,
                          .pressing = pressing_forces(coordinates, obstacles, at)};
  box.apply = [&](const algebra::Vector& z, algebra::Vector& f) {
    matrix.multiply(z, f);
    for (std::size_t i = 0; box.shift > 0 && i < f.owned().size(); ++i)
      f.owned()[i] += box.shift * diagonal.owned()[i] * z.owned()[i];
  };
  algebra::Factorisation factor(matrix);
  const auto expected = assembly::likely_activity(coordinates, state.touching);
  contact::BoxSolution z = contact::solve(box, expected, factor, settings, observer);
  while (is_indefinite(z.status) && box.shift < largest_shift) {
    box.shift = box.shift == 0 ? least_shift : 4 * box.shift;
    z = contact::solve(box, expected, factor, settings, observer);
  }
  NewtonStep step{.status = z.status, .factorisations = factor.factorisations(), .shift = box.shift};
  step.end.positions = state.positions;
  if (z.status != contact::Status::solved) return step;
  algebra::Vector increment(layout, 6);
  coordinates.to_cartesian(z.z, increment);
  step.largest_rotation = largest_rotation(increment);
  step.largest_displacement = solution::largest_displacement(increment);
  set_stresses(discrete, state.y, increment, step);
  set_reactions(discrete, points, coordinates, z, step);
  const auto pressed = assembly::pressed_obstacles(obstacles, at);
  for (std::size_t j = 0; j < pressed.size(); ++j) step.end.positions[pressed[j]] += z.positions[j];
  for (std::size_t k = 0; k < space->bodies.size(); ++k) {
    const fem::BodyMotion motion = fem::motion_of(*space, space->bodies[k], increment);
    step.end.bodies.push_back(
        {state.bodies[k].displacement + motion.displacement, rotation_by(motion.rotation) * state.bodies[k].turn});
  }
  step.end.y = state.y;
  algebra::axpy(1, increment, step.end.y);
  step.end.y.update_ghosts();
  return step;
}

State next_state(const assembly::DiscreteShell& discrete, const State& state, const NewtonStep& step) {
  State next = step.end;
  if (step.is_too_long()) {
    const double part = NewtonStep::longest_rotation / step.largest_rotation;
    interpolate(part, state.y.local(), step.end.y.local(), next.y.local());
    interpolate(part, state.positions, step.end.positions, next.positions);
    for (std::size_t k = 0; k < next.bodies.size(); ++k)
      next.bodies[k] = part_of_way(part, state.bodies[k], next.bodies[k]);
    for (std::size_t c = 0; c < next.stresses.size(); ++c)
      next.stresses[c] = state.stresses[c] + part * (step.end.stresses[c] - state.stresses[c]);
  }
  next.y = with_unit_directors(discrete, std::move(next.y), next.bodies);
  return next;
}

}  // namespace plastron::finite

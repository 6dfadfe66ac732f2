#include <plastron/finite/newton_step.hpp>

#include <plastron/algebra/factorisation.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/finite/controlled_point.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::finite {

using assembly::ContactRow;
using assembly::NodalCoordinates;
using Eigen::Vector3d;

namespace {

/// Returns (u, r) after the step.
algebra::Vector after(const assembly::DiscreteShell& discrete, const NewtonStep& step) {
  algebra::Vector y = discrete.state.displacement;
  algebra::axpy(1, step.increment, y);
  y.update_ghosts();
  return y;
}

/// Returns the linearised strains after the step.
CellStrain strains_after(const assembly::DiscreteShell& discrete, const NewtonStep& step, std::size_t cell) {
  const energy::ShellOperator& shell = discrete.shell;
  return shell.finite_strains(cell, shell.gather(cell, discrete.state.displacement)) +
         shell.strains(cell, shell.gather(cell, step.increment), discrete.geometry(cell));
}

/// Calls visit(row, force) for the nodes that touch after the step.
template <class Visit>
void for_reactions(const NodalCoordinates& coordinates, const contact::BoxSolution& box, const Visit& visit) {
  for (const ContactRow& row : coordinates.rows) {
    if (!row.binds) continue;
    const std::size_t unknown = coordinates.at(row.node, row.coordinate);
    if (box.activity[unknown] == bound_of(row)) visit(row, box.multiplier.owned()[unknown] / row.scale);
  }
}

/// Returns the start of the next step, before a shortening.
StepStart start_after(const assembly::DiscreteShell& discrete, const NewtonStep& step) {
  const NodalCoordinates& coordinates = discrete.coordinates;
  const auto& layout = discrete.space().layout;
  StepStart next{.prestress = {.contact_forces = algebra::Vector(layout, 6),
                               .forces_of_terms = forces_of_terms(discrete, after(discrete, step), false)},
                 .zone = algebra::Vector(layout, discrete.obstacle_block())};
  for (std::size_t c = 0; c < discrete.space().owned_cells; ++c)
    next.prestress.stresses.push_back(discrete.stresses(c, strains_after(discrete, step, c)));
  for_reactions(coordinates, step.box, [&](const ContactRow& row, double force) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    add_contact_force(force, coordinates.gaps[k][row.node], row.node, next.prestress.contact_forces);
    next.zone.at(row.node)[k] = 1;
  });
  next.zone.update_ghosts();
  return next;
}

constexpr double largest_shift = 0.3;

/// Returns the contact problem of increments with this stiffness.
contact::BoxProblem increments(const assembly::DiscreteShell& discrete, const algebra::Matrix& matrix) {
  const NodalCoordinates& coordinates = discrete.coordinates;
  algebra::Vector forces(discrete.space().layout, 6), load(discrete.space().layout, coordinates.width);
  discrete.residual(discrete.state.displacement, forces);
  coordinates.add_transposed(forces, load);
  for (double& value : load.local()) value = -value;
  return {.matrix = matrix,
          .apply = [&matrix](const algebra::Vector& z, algebra::Vector& f) { matrix.multiply(z, f); },
          .load = std::move(load),
          .lower = coordinates.lower,
          .upper = coordinates.upper,
          .may_be_indefinite = true,
          .pressing = pressing_forces(coordinates, discrete.obstacles, discrete.state)};
}

/// Changes the load factor so that the controlled displacement gets its value, on the face that the step has found.
void adjust_loads(const ControlledPoint& control, const contact::BoxProblem& box, algebra::Factorisation& factor,
                  NewtonStep& step) {
  const contact::BoxSolution& found = step.box;
  const auto& layout = found.z.layout();
  std::vector<char> fixed(found.activity.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) fixed[i] = found.activity[i] != contact::Activity::free;
  algebra::Vector rate = control.load_rate(), forces = rate, response(layout, rate.block());
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i]) forces.owned()[i] = 0;
  const double rest = control.rest() - algebra::dot(control.row(), found.z);
  step.box.status = contact::Status::no_equilibrium;
  if (!factor.factorise(fixed, box.shift)) return;
  factor.solve(forces, response);
  response.update_ghosts();
  constexpr double rounding = 1e-10;
  const double moved = algebra::dot(control.row(), response);
  step.is_control_blind = !(std::abs(moved) > rounding * std::sqrt(algebra::dot(control.row(), control.row())) *
                                                  algebra::max_abs(response));
  const double change = rest / moved;
  if (step.is_control_blind || !std::isfinite(change)) return;
  step.box.status = contact::Status::solved;
  step.load_change = change;
  algebra::axpy(change, response, step.box.z);
  step.box.z.update_ghosts();
  box.apply(response, forces);
  algebra::axpy(-1, rate, forces);
  algebra::axpy(change, forces, step.box.multiplier);
}

double largest_rotation(const algebra::Vector& increment) {
  double largest = 0;
  for (std::size_t i = 0; i < increment.owned().size(); i += 6)
    largest = std::max(largest, Eigen::Map<const Vector3d>(increment.owned().data() + i + 3).norm());
  return algebra::max_over_ranks(largest, increment.layout()->comm);
}

}  // namespace

bool has_no_minimiser(contact::Status status) {
  return status == contact::Status::singular || status == contact::Status::not_held;
}

std::unique_ptr<assembly::DiscreteShell> with_finite_rotations(const assembly::DiscreteShell& discrete,
                                                               const solution::NodalSolution& solution) {
  auto result = std::make_unique<assembly::DiscreteShell>(discrete);
  result->set_rotations(element::Rotations::finite);
  assembly::State state = discrete.state;
  state.positions = discrete.positions();
  state.displacement = solution.y;
  linearise(*result, std::move(state));
  return result;
}

NewtonStep newton_step(const assembly::DiscreteShell& discrete, const StepStart& start,
                       const contact::Settings& settings, const contact::Observer& observer) {
  const auto& layout = discrete.space().layout;
  const NodalCoordinates& coordinates = discrete.coordinates;
  algebra::Matrix matrix = tangent_matrix(discrete, start.prestress, coordinates);
  std::optional<ControlledPoint> control;
  if (discrete.state.control) control.emplace(discrete);
  const double rho = control ? control->stiffness(matrix) : 0;
  if (control) control->add(rho, matrix);
  const algebra::Vector diagonal = matrix.diagonal();
  contact::BoxProblem box = increments(discrete, matrix);
  if (control) algebra::axpy(rho * control->rest(), control->row(), box.load);
  box.shift = start.shift;
  std::optional<algebra::Matrix> geometric;
  box.apply = [&](const algebra::Vector& z, algebra::Vector& f) {
    if (geometric)
      multiply_through_strains(discrete, *geometric, z, f);
    else
      matrix.multiply(z, f);
    for (std::size_t i = 0; box.shift > 0 && i < f.owned().size(); ++i)
      f.owned()[i] += box.shift * diagonal.owned()[i] * z.owned()[i];
  };
  algebra::Factorisation factor(matrix);
  const auto expected =
      start.zone.layout() ? assembly::likely_activity(coordinates, start.zone) : std::vector<contact::Activity>{};
  NewtonStep step{.box = contact::solve(box, expected, factor, settings, observer)};
  if (step.status() == contact::Status::linear_solver_stalled) {
    geometric.emplace(geometric_matrix(discrete, start.prestress, coordinates));
    if (control) control->add(rho, *geometric);
    step.box = contact::solve(box, expected, factor, settings, observer);
  }
  const auto needs_shift = [&] {
    return has_no_minimiser(step.status()) || step.status() == contact::Status::linear_solver_stalled;
  };
  if (needs_shift() && start.prestress.is_exact) {
    StepStart other = start;
    other.prestress.is_exact = false;
    NewtonStep again = newton_step(discrete, other, settings, observer);
    again.factorisations += factor.factorisations();
    return again;
  }
  while (needs_shift() && box.shift < largest_shift) {
    box.shift = std::max(4 * box.shift, start.next_shift);
    step.box = contact::solve(box, expected, factor, settings, observer);
  }
  step.factorisations = factor.factorisations();
  step.shift = box.shift;
  if (control && step.status() == contact::Status::solved) {
    adjust_loads(*control, box, factor, step);
    step.factorisations = factor.factorisations();
  }
  if (step.status() != contact::Status::solved) return step;
  step.increment = algebra::Vector(layout, 6);
  coordinates.to_cartesian(step.box.z, step.increment);
  step.largest_rotation = largest_rotation(step.increment);
  step.largest_displacement = solution::largest_displacement(step.increment);
  step.part = assembly::part_by_beds(discrete, after(discrete, step), step.increment, step.box.positions);
  step.next = start_after(discrete, step);
  return step;
}

StepTotals totals_after(const assembly::DiscreteShell& discrete, const NewtonStep& step) {
  const NodalCoordinates& coordinates = discrete.coordinates;
  const MPI_Comm comm = discrete.space().layout->comm;
  StepTotals totals{.energy = discrete
                                  .energies_of([&](std::size_t cell) { return strains_after(discrete, step, cell); },
                                               after(discrete, step))
                                  .total(),
                    .obstacle_forces{coordinates.gaps.size(), Vector3d::Zero()}};
  for_reactions(coordinates, step.box, [&](const ContactRow& row, double force) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    totals.obstacle_forces[k] += force * coordinates.gaps[k][row.node].normal;
    totals.contact_area += discrete.points[row.node].weight;
  });
  for (Vector3d& force : totals.obstacle_forces)
    for (double& component : force) component = algebra::sum_over_ranks(component, comm);
  totals.contact_area = algebra::sum_over_ranks(totals.contact_area, comm);
  return totals;
}

double potential(const assembly::DiscreteShell& discrete, double weight) {
  const algebra::Vector& y = discrete.state.displacement;
  double depth = 0, of_beds = 0;
  for (const ContactRow& row : discrete.coordinates.rows) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    if (!row.binds) continue;
    const double closed =
        std::max(0.0, discrete.state.lift(row.node, k) - discrete.coordinates.gaps[k][row.node].initial);
    if (const obstacle::Bed& bed = discrete.obstacles.all[k].bed; row.bed > 0)
      of_beds += discrete.points[row.node].weight * bed.energy(bed.pressure(closed));
    else
      depth += closed;
  }
  return discrete.energies(y).total() - algebra::dot(discrete.load, y) +
         algebra::sum_over_ranks(of_beds + weight * depth, discrete.space().layout->comm);
}

double largest_reaction(const assembly::DiscreteShell& discrete, const NewtonStep& step) {
  double largest = 0;
  for_reactions(discrete.coordinates, step.box,
                [&](const ContactRow& /*row*/, double force) { largest = std::max(largest, std::abs(force)); });
  return algebra::max_over_ranks(largest, discrete.space().layout->comm);
}

ProblemAtSolution problem_at(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                             const contact::BoxSolution& solved, const algebra::Matrix& matrix) {
  if (!discrete.has_increments()) return {.box = assembly::box_problem(discrete, matrix), .z = solved};
  const NodalCoordinates& coordinates = discrete.coordinates;
  ProblemAtSolution at{.box = increments(discrete, matrix),
                       .z = {.status = contact::Status::solved,
                             .z = algebra::Vector(discrete.space().layout, coordinates.width),
                             .activity = assembly::likely_activity(coordinates, solution.touching)}};
  at.z.multiplier = at.box.load;
  for (double& value : at.z.multiplier.local()) value = -value;
  for (const ContactRow& row : coordinates.rows)
    if (row.bed > 0) at.z.z.owned()[coordinates.at(row.node, row.coordinate)] = std::max(0.0, -row.bound_gap);
  coordinates.add_bed_forces(at.z.z, at.z.multiplier);
  at.z.z.update_ghosts();
  const std::vector<char> prescribed = coordinates.prescribed();
  for (std::size_t i = 0; i < prescribed.size(); ++i)
    if (prescribed[i]) at.z.activity[i] = contact::Activity::prescribed;
  at.z.positions.assign(at.box.pressing.size(), 0);
  return at;
}

assembly::State next_state(const assembly::DiscreteShell& discrete, const StepStart& start, NewtonStep& step) {
  const double part = std::min(step.part.value_or(1.0),
                               step.is_too_long() ? NewtonStep::longest_rotation / step.largest_rotation : 1.0);
  assembly::State next = discrete.state;
  const auto pressed = assembly::pressed_obstacles(discrete);
  next.positions = discrete.positions();
  for (std::size_t j = 0; j < pressed.size(); ++j) next.positions[pressed[j]] += part * step.box.positions[j];
  if (next.control) next.factors.controlled(next.control->factor) += part * step.load_change;
  next.displacement = discrete.state.displacement;
  algebra::axpy(part, step.increment, next.displacement);
  next.displacement.update_ghosts();
  if (part < 1)
    for (std::size_t c = 0; c < start.prestress.stresses.size(); ++c) {
      CellStrain& stresses = step.next.prestress.stresses[c];
      stresses = start.prestress.stresses[c] + part * (stresses - start.prestress.stresses[c]);
    }
  return next;
}

}  // namespace plastron::finite

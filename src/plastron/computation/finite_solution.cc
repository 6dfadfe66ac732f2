#include <plastron/computation/finite_solution.hpp>

#include <plastron/computation/relinearisation.hpp>
#include <plastron/finite/modes.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::computation {

namespace {

/// Number of Newton steps after which a shell with finite rotations has no equilibrium near its state.
constexpr int most_newton_steps = 60;
/// Size of steps that end the iteration, and of steps that end it when they no longer get smaller: there rounding begins.
constexpr double negligible_step = 1e-9, tiny_step = 1e-8, small_step = 1e-5;
/// Expected size of the next step that ends the iteration where only the values of goals are needed, to some digits.
constexpr double negligible_for_values = 1e-5;

/// Number of steps that may be lengthened.
constexpr int most_lengthenings = 4;

/// Largest size of a step, and least ratio to the step before it, after which the exact derivative of the residual is tried.
constexpr double near_end = 0.1, slow = 0.05;
/// Part of a shift with which the next step begins if the shift shortens the steps, and the least such shift without contact: a
/// smaller one lets rounding lead a perfect shell away from the unstable state that it cannot leave by itself.
constexpr double next_part_of_shift = 1.0 / 16, least_without_contact = 1e-6;

/// Strain that rounding leaves in a shell without forces.
constexpr double rounding_strain = 1e-15;

/// Ratio of the way of the shell to its first step, the linear prediction, beyond which a shell that lost the stiffness of a
/// motion on the way has snapped; it is then a large part of the displacement, unlike the way from a coarser mesh.
constexpr double far_beyond = 3, large_part = 0.2;

double largest_way(algebra::Vector before, const algebra::Vector& now) {
  algebra::axpy(-1, now, before);
  return solution::largest_displacement(before);
}

/// Whether a short step has ended in a shell without strain: what follows is rounding, however large beside displacements that are
/// rounding, too (collective).
bool is_unstrained_after(const assembly::DiscreteShell& discrete, const finite::NewtonStep& step) {
  if (step.largest_rotation >= small_step) return false;
  double energy = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const assembly::NodalPoint& point = discrete.points[i];
    energy += rounding_strain * rounding_strain * point.young * point.weight * point.thickness / 2;
  }
  const MPI_Comm comm = discrete.space().layout->comm;
  // Initial strains store energy in a shell without strain.
  const double of_strains =
      discrete.shell.energies_of([&](std::size_t cell) { return discrete.strains(cell, discrete.state.displacement); })
          .total();
  return step.largest_displacement < small_step * least_thickness(discrete) &&
         of_strains < algebra::sum_over_ranks(energy, comm);
}

/// Product of the rotations of two motions (collective).
double product_of_rotations(const algebra::Vector& a, const algebra::Vector& b) {
  double product = 0;
  for (std::size_t i = 0; i < a.owned().size(); ++i)
    if (i % 6 > 2) product += a.owned()[i] * b.owned()[i];
  return algebra::sum_over_ranks(product, a.layout()->comm);
}

/// Lengthens a small step that repeats the one before it, times a factor q. The stiffness of the steps is not exactly the derivative
/// of the residual, and where q > 1 they lead away from the equilibrium. The sum of all such steps, 1 / (1 - q), leads to it (Aitken).
/// Returns whether the step has changed (collective).
bool lengthened(const algebra::Vector& last, finite::NewtonStep& step) {
  constexpr double least_factor = 0.5, parallel = 0.99, least_difference = 0.1;
  if (step.shift > 0 || !(step.largest_rotation < small_step)) return false;
  const double own = product_of_rotations(last, last), both = product_of_rotations(last, step.increment),
               now = product_of_rotations(step.increment, step.increment);
  const double q = both / own;
  if (!(std::abs(both) > parallel * std::sqrt(own * now)) || !(std::abs(q) > least_factor) ||
      !(std::abs(1 - q) > least_difference))
    return false;
  const double sum = 1 / (1 - q);
  for (double& value : step.increment.local()) value *= sum;
  for (double& position : step.box.positions) position *= sum;
  step.load_change *= sum;
  return true;
}

/// Solves with finite rotations, by Newton steps from the state of the shell with the stresses and the zone of `start`.
Found newton_solution(LevelRun& run, finite::StepStart start) {
  assembly::DiscreteShell& discrete = run.discrete();
  solution::NodalSolution nodal =
      solution::nodal_solution(discrete, algebra::Vector(discrete.space().layout, discrete.obstacle_block()));
  finite::NewtonStep step;
  double before = std::numeric_limits<double>::infinity(), predicted = 0;
  bool lost_stiffness = false;
  algebra::Vector last;
  int lengthenings = 0;
  for (int steps = 0; steps < most_newton_steps; ++steps) {
    step = run.newton_step(start);
    run.is_control_blind = step.is_control_blind;
    lost_stiffness = lost_stiffness || (step.shift > 0 && steps > 0);
    if (steps == 0) predicted = step.largest_displacement;
    if (finite::has_no_minimiser(step.status())) step.box.status = contact::Status::no_equilibrium;
    if (step.status() != contact::Status::solved) break;
    const bool is_lengthened = steps > 0 && !step.part && lengthenings < most_lengthenings && lengthened(last, step);
    lengthenings += is_lengthened ? 1 : 0;
    linearise(discrete, finite::next_state(discrete, start, step));
    const double displacement = solution::largest_displacement(discrete.state.displacement);
    start = std::move(step.next);
    // An obstacle that a force presses may move alone: lifted bounds push it, and not the shell.
    double way = step.largest_displacement;
    for (const double position : step.box.positions) way = std::max(way, std::abs(position));
    const double size = std::max(step.largest_rotation, displacement > 0 ? way / displacement : 0);
    start.prestress.is_exact = step.shift == 0 && size < near_end && size > slow * before;
    if (step.shift > 0) {
      const bool touches = !step.box.iterations.empty() && step.box.iterations.back().active > 0;
      const double smaller = std::max(next_part_of_shift * step.shift, touches ? 0.0 : least_without_contact);
      start.next_shift = size < before ? smaller : step.shift;
    }
    // A slow iteration, as with stiffness that is not symmetric, shrinks its steps by less than a tenth, too.
    const bool is_rounding = !is_lengthened && size < small_step && size > (size < tiny_step ? 0.9 : 1.0) * before;
    const double rate = std::isinf(before) ? 1 : std::min(size / before, 1.0);
    const bool is_enough = run.is_for_values() && size < near_end && rate * size <= negligible_for_values;
    before = size;
    last = std::move(step.increment);
    if (size <= negligible_step ||
        (step.shift == 0 && !step.part && (is_enough || is_rounding || is_unstrained_after(discrete, step))))
      break;
    if (steps + 1 == most_newton_steps) step.box.status = contact::Status::no_equilibrium;
  }
  run.has_lost_stiffness = run.has_lost_stiffness || lost_stiffness;
  run.needed_shift = step.shift > 0;
  const double way = lost_stiffness ? largest_way(nodal.y, discrete.state.displacement) : 0;
  const double whole = solution::largest_displacement(discrete.state.displacement);
  run.has_jumped = run.has_jumped || (way > far_beyond * predicted && way > large_part * whole);
  if (held_inside_obstacle(discrete)) step.box.status = contact::Status::infeasible;
  if (start.zone.layout()) nodal = solution::nodal_solution(discrete, start.zone);
  return {std::move(step.box), std::move(nodal)};
}

/// Whether prescribed components of u and r have their values.
bool supports_stand(const assembly::DiscreteShell& discrete) {
  constexpr double rest_part = 1e-12;
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const std::vector<char> prescribed = coordinates.prescribed();
  double rest = 0;
  for (std::size_t i = 0; i < prescribed.size(); ++i)
    if (prescribed[i]) rest = std::max(rest, std::abs(coordinates.lower.owned()[i]));
  return algebra::max_over_ranks(rest, discrete.space().layout->comm) <=
         rest_part * solution::largest_displacement(discrete.state.displacement);
}

/// Whether loads have a potential that finite::potential() computes.
bool has_potential(const assembly::DiscreteShell& discrete) {
  return !discrete.has_follower_pressure() && discrete.space().bodies.empty() && !discrete.state.control &&
         assembly::pressed_obstacles(discrete).empty();
}

/// Linearises the shell at a state and returns its potential there, infinity where it has none: a gap has no direction, or a support
/// cannot hold (collective).
double potential_at(assembly::DiscreteShell& discrete, assembly::State state, double weight) {
  try {
    linearise(discrete, std::move(state));
    return finite::potential(discrete, weight);
  } catch (const obstacle::ObstacleError&) {
  } catch (const assembly::SupportError&) {
  }
  return std::numeric_limits<double>::infinity();
}

/// Goes on from the state of the shell in the direction from `before`, twice as far each time, while that lowers the potential: a shell
/// that snaps moves far, and where it begins to, Newton steps are short (collective).
void lengthen(assembly::DiscreteShell& discrete, const assembly::State& before, double weight) {
  constexpr int most_doublings = 8;
  algebra::Vector direction = discrete.state.displacement;
  algebra::axpy(-1, before.displacement, direction);
  double lowest = finite::potential(discrete, weight), factor = 1;
  for (int i = 0; i < most_doublings; ++i, factor *= 2) {
    const assembly::State nearer = discrete.state;
    assembly::State further = nearer;
    algebra::axpy(factor, direction, further.displacement);
    further.displacement.update_ghosts();
    const double potential = potential_at(discrete, std::move(further), weight);
    if (!(potential < lowest)) return linearise(discrete, nearer);
    lowest = potential;
  }
}

/// Goes back from the state of the shell towards `before`, half as far each time, until the potential is below `merit`: a step that is
/// too long for the stiffness at its beginning still points downwards. Returns the potential, which may end above (collective).
double shorten(assembly::DiscreteShell& discrete, const assembly::State& before, double merit, double weight) {
  constexpr int most_halvings = 4;
  algebra::Vector half = discrete.state.displacement;
  algebra::axpy(-1, before.displacement, half);
  double potential = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_halvings && !(potential < merit); ++i) {
    for (double& value : half.local()) value /= 2;
    assembly::State nearer = discrete.state;
    algebra::axpy(-1, half, nearer.displacement);
    nearer.displacement.update_ghosts();
    potential = potential_at(discrete, std::move(nearer), weight);
  }
  return potential;
}

/// Descends from the state of the shell towards a local minimum of the potential: Newton steps with the stresses of the state and
/// a stiffness to which a multiple of the diagonal is added until they lower it. Returns the start of the steps that finish;
/// empty if the shell has not descended. Needed where it snaps away from an obstacle.
std::optional<finite::StepStart> descended(LevelRun& run) {
  constexpr int most_steps = 200;
  constexpr double near = 1e-4, first_shift = 1e-3, least_shift = 1e-6, largest_shift = 1e2;
  assembly::DiscreteShell& discrete = run.discrete();
  algebra::Vector zone(discrete.space().layout, discrete.obstacle_block());
  const auto start_with = [&](double shift) {
    return finite::StepStart{.prestress = finite::prestress(discrete, solution::nodal_solution(discrete, zone)),
                             .zone = zone,
                             .shift = shift};
  };
  double shift = 0, weight = algebra::max_abs(discrete.load);
  bool has_descended = false;
  for (int steps = 0; steps < most_steps && shift < largest_shift; ++steps) {
    const finite::StepStart start = start_with(shift);
    finite::NewtonStep step = run.newton_step(start);
    if (step.status() != contact::Status::solved) return {};
    const assembly::State before = discrete.state;
    weight = std::max(weight, 2 * finite::largest_reaction(discrete, step));
    const double merit = finite::potential(discrete, weight);
    linearise(discrete, finite::next_state(discrete, start, step));
    double potential = finite::potential(discrete, weight);
    if (!(potential < merit)) potential = shorten(discrete, before, merit, weight);
    if (potential < merit) {
      lengthen(discrete, before, weight);
      has_descended = true;
      zone = std::move(step.next.zone);
      shift = step.shift / 4 < least_shift ? 0 : step.shift / 4;
      const double whole = solution::largest_displacement(discrete.state.displacement);
      if (step.shift == 0 && step.largest_displacement < near * whole) break;
    } else {
      linearise(discrete, before);
      shift = std::max(first_shift, 4 * step.shift);
    }
  }
  if (!has_descended) return {};
  return start_with(0);
}

/// A motion along which a shell leaves its equilibrium, and how far it moves at first, as a part of the thickness.
struct Escape {
  algebra::Vector motion{};
  double size = 0;
  bool is_stable = false;  // idle contact holds the shell, unless `size` suffices to lower the potential
};

/// Returns the softest motion, towards the state before (M36), where that lowers the energy; else the one that idle contact alone keeps
/// from lowering it, away from the obstacle. Without layout if there is none (collective).
Escape escape_from(const assembly::DiscreteShell& discrete, const Found& found, const algebra::Vector& before) {
  constexpr double snap = 0.1, disturbance = 0.01;
  finite::ExaminedStability examined = finite::examine_stability(discrete, found.nodal);
  if (examined.motion.layout() && !(examined.stability.margin > 0)) {
    algebra::Vector back = before;
    algebra::axpy(-1, discrete.state.displacement, back);
    const double size = algebra::dot(back, examined.motion) < 0 ? -snap : snap;
    return {.motion = std::move(examined.motion), .size = size};
  }
  return {.motion = std::move(examined.away), .size = disturbance, .is_stable = true};
}

/// Moves the shell from its equilibrium, further and further while that lowers the potential. Returns whether it escapes; `energy`: the
/// potential of the equilibrium (collective).
bool has_escaped(assembly::DiscreteShell& discrete, const Escape& escape, double energy) {
  const assembly::State equilibrium = discrete.state;
  assembly::State next = equilibrium;
  algebra::axpy(escape.size * least_thickness(discrete), escape.motion, next.displacement);
  next.displacement.update_ghosts();
  const double potential = potential_at(discrete, std::move(next), 0);
  if (std::isinf(potential) || (escape.is_stable && !(potential < energy))) return false;
  lengthen(discrete, equilibrium, 0);
  return true;
}

/// Leaves an equilibrium that is not stable, or that idle contact alone holds, for the one of lower energy to which the shell snaps; if
/// that is not found, the shell stays (collective).
Found left(LevelRun& run, Found found, const algebra::Vector& before) {
  assembly::DiscreteShell& discrete = run.discrete();
  const Escape escape = escape_from(discrete, found, before);
  if (!escape.motion.layout()) return found;
  const assembly::State equilibrium = discrete.state;
  const double energy = finite::potential(discrete, 0);
  if (has_escaped(discrete, escape, energy))
    if (auto near = descended(run)) {
      Found lower = newton_solution(run, std::move(*near));
      if (lower.z.status == contact::Status::solved && !run.needed_shift && finite::potential(discrete, 0) < energy) {
        run.has_jumped = true;
        return lower;
      }
    }
  linearise(discrete, equilibrium);
  return found;
}

}  // namespace

Found solved_finite(LevelRun& run, const algebra::Vector* zone) {
  assembly::DiscreteShell& discrete = run.discrete();
  const assembly::State before = discrete.state;
  // The stresses of an interpolated state are not used: rotations that do not fit leave a false stretch in it.
  finite::StepStart start{.prestress = finite::no_prestress(discrete)};
  if (zone) start.zone = *zone;
  Found found = newton_solution(run, std::move(start));
  if (found.z.status == contact::Status::solved && run.leaves_unstable() && has_potential(discrete) &&
      (run.needed_shift || finite::has_idle_contact(discrete, found.nodal)))
    return left(run, std::move(found), before.displacement);
  if (found.z.status != contact::Status::no_equilibrium || !has_potential(discrete)) return found;
  linearise(discrete, before);
  auto near = supports_stand(discrete) ? descended(run) : std::nullopt;
  if (!near) {
    if (run.is_stopped()) found.z.status = contact::Status::interrupted;
    found.nodal = solution::nodal_solution(discrete, found.nodal.touching);
    return found;
  }
  Found lower = newton_solution(run, std::move(*near));
  run.has_jumped = run.has_jumped || lower.z.status == contact::Status::solved;
  return lower;
}

}  // namespace plastron::computation

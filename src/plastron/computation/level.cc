#include <plastron/computation/level.hpp>

#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/computation/bound_lifts.hpp>
#include <plastron/computation/contact_forecast.hpp>
#include <plastron/computation/relinearisation.hpp>
#include <plastron/computation/resources.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/estimation/estimate.hpp>
#include <plastron/estimation/kept_factorisation.hpp>
#include <plastron/finite/newton_step.hpp>

namespace plastron::computation {

namespace {

/// Whether a support fixes the touching face inside an obstacle, so that K is empty. No bound shows this, because
/// nothing can move there.
bool held_inside_obstacle(const assembly::DiscreteShell& discrete) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  std::int64_t fixed = 0;
  for (const assembly::ContactRow& row : coordinates.rows)
    if (coordinates.is_fixed_inside(row, discrete.points[row.node])) ++fixed;
  return algebra::sum_over_ranks(fixed, discrete.space().layout->comm) > 0;
}

/// Adds the solver's data to the measures of a level.
Level record_of(Level level, const contact::BoxSolution& z) {
  level.status = z.status;
  level.linear_residual = z.linear_residual;
  level.tolerances = z.tolerances;
  return level;
}

/// Matrix, factor and box program of a contact problem. They are kept to the end because error estimates use the
/// factor.
struct LinearAlgebra {
  LinearAlgebra(algebra::Matrix matrix, const std::vector<char>& movable, MPI_Comm comm)
      : A(std::move(matrix)), F(A, movable), kept(F, comm) {}
  algebra::Matrix A;
  algebra::Factorisation F;
  estimation::KeptFactorisation kept;
  std::optional<contact::BoxProblem> box{};
};

/// A level during its solution: its shell in the present linearisation.
class LevelRun {
 public:
  LevelRun(const LevelTask& task, std::unique_ptr<assembly::DiscreteShell> discrete, const Observer& observer)
      : seconds(task.seconds), task_(task), discrete_(std::move(discrete)), observer_(observer) {}

  Seconds seconds;
  int factorisations = 0, linearisations = 0;
  bool has_jumped = false, is_control_blind = false;  ///< see Level
  std::vector<contact::Iteration> history{};

  /// Solves the contact problem of the present linearisation, starting from the expected zone; null if there is none.
  contact::BoxSolution solve(const algebra::Vector* zone, bool detect_free_motions) {
    Stopwatch watch;
    tell("assembly");
    last_.reset();
    algebra::Matrix A = assembly::stiffness_matrix(*discrete_);
    seconds.assembly += watch.lap();
    tell("analysis");
    contact::Settings settings = task_.settings;
    settings.detect_free_motions = settings.detect_free_motions && detect_free_motions;
    const bool knows_zone = zone && !settings.detect_free_motions;
    last_ = std::make_unique<LinearAlgebra>(std::move(A),
                                            knows_zone ? open_coordinates(*discrete_, *zone) : std::vector<char>{},
                                            discrete_->space().layout->comm);
    const algebra::Factorisation& F = last_->F;
    seconds.analysis += watch.lap();
    tell("contact");
    const contact::BoxProblem& box = last_->box.emplace(assembly::box_problem(*discrete_, last_->A));
    const auto guess =
        zone ? assembly::likely_activity(discrete_->coordinates, *zone) : std::vector<contact::Activity>{};
    contact::BoxSolution z = contact::solve(box, guess, last_->kept, settings, follow());
    if (!z.positions.empty()) press(*discrete_, z.positions);
    if (held_inside_obstacle(*discrete_)) z.status = contact::Status::infeasible;
    seconds.factorisation += F.seconds_numeric();
    seconds.iteration += watch.lap() - F.seconds_numeric();
    factorisations += F.factorisations();
    history.insert(history.end(), z.iterations.begin(), z.iterations.end());
    return z;
  }

  /// Prepares dual problems at a solution with finite rotations.
  contact::BoxSolution prepare_duals(const solution::NodalSolution& nodal) {
    Stopwatch watch;
    last_ = std::make_unique<LinearAlgebra>(finite::hessian(*discrete_, nodal, discrete_->coordinates),
                                            std::vector<char>{}, discrete_->space().layout->comm);
    finite::ProblemAtSolution at = finite::problem_at(*discrete_, nodal, last_->A);
    last_->box.emplace(std::move(at.box));
    seconds.estimates += watch.lap();
    return std::move(at.z);
  }

  std::vector<double> values(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                             const solution::Summary& summary) const {
    return estimation::values(task_.valued, solved(z, nodal, summary));
  }

  /// Makes a Newton step from the state of the shell.
  finite::NewtonStep newton_step(const finite::StepStart& start) {
    Stopwatch watch;
    tell("contact");
    contact::Settings settings = task_.settings;
    settings.solver = nullptr;  // others need a definite matrix
    finite::NewtonStep step = finite::newton_step(*discrete_, start, settings, follow());
    seconds.iteration += watch.lap();
    factorisations += step.factorisations;
    ++linearisations;
    history.insert(history.end(), step.box.iterations.begin(), step.box.iterations.end());
    return step;
  }

  /// Estimates the errors of the solution of the last solve() and of its goals.
  estimation::Estimates estimate(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                                 const solution::Summary& summary) {
    Stopwatch watch;
    tell("estimates");
    last_->kept.keep();
    auto estimates = estimation::estimate(solved(z, nodal, summary), last_->kept, *task_.goals);
    seconds.estimates += watch.lap();
    return estimates;
  }

  std::optional<double> buckling(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                                 const solution::Summary& summary) {
    Stopwatch watch;
    last_->kept.keep();
    const auto found = estimation::buckling(solved(z, nodal, summary), last_->kept);
    seconds.estimates += watch.lap();
    return found;
  }

  bool is_stopped() const { return wants_to_stop(observer_, discrete_->space().layout->comm); }
  void tell(std::string_view phase) const {
    if (observer_.phase) observer_.phase(task_.number, phase);
  }
  assembly::DiscreteShell& discrete() { return *discrete_; }
  std::unique_ptr<assembly::DiscreteShell> take() { return std::move(discrete_); }

 private:
  estimation::Solved solved(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                            const solution::Summary& summary) const {
    return {.discrete = *discrete_,
            .nodal = nodal,
            .box = *last_->box,
            .z = z,
            .singular = recovery::singular_places(*discrete_, summary)};
  }

  contact::Observer follow() const {
    return {.iteration =
                [this](const contact::Iteration& i) {
                  if (observer_.iteration) observer_.iteration(task_.number, i);
                },
            .stop = [this] { return wants_to_stop(observer_, discrete_->space().layout->comm); }};
  }

  const LevelTask& task_;
  std::unique_ptr<assembly::DiscreteShell> discrete_;
  std::unique_ptr<LinearAlgebra> last_{};
  const Observer& observer_;
};

/// A solution of a level's contact problem.
struct Found {
  contact::BoxSolution z;
  solution::NodalSolution nodal;
};

/// Solves with small rotations, and repeats the linearisation until the linearised gaps agree with the position of the
/// shell.
Found solved_linear(LevelRun& run, const LevelTask& task, const algebra::Vector* zone, bool detect_free_motions) {
  Relinearisation outer(task.linearisation, run.discrete());
  contact::BoxSolution z = run.solve(zone, detect_free_motions);
  solution::NodalSolution nodal = solution::nodal_solution(run.discrete(), z);
  while (z.status == contact::Status::solved) {
    auto state = outer.next(nodal);
    if (!state) break;
    const ContactTrend trend = contact_trend(run.discrete(), nodal);
    linearise(run.discrete(), std::move(*state));
    const algebra::Vector expected = expected_zone(run.discrete(), trend);
    z = run.solve(&expected, !supports_hold(run.history, task.settings));
    nodal = solution::nodal_solution(run.discrete(), z);
  }
  run.linearisations += outer.steps();
  if (z.status == contact::Status::solved && !outer.is_met()) z.status = contact::Status::gap_not_met;
  return {std::move(z), std::move(nodal)};
}

/// Number of Newton steps after which a shell with finite rotations has no equilibrium near its state.
constexpr int most_newton_steps = 60;
/// Size of steps that end the iteration, and of steps that end it when they no longer get smaller: there rounding begins.
constexpr double negligible_step = 1e-9, tiny_step = 1e-8, small_step = 1e-5;

/// Ratio of the way of the shell to its first step, the linear prediction, beyond which a shell that lost the stiffness of a
/// motion on the way has snapped; it is then a large part of the displacement, unlike the way from a coarser mesh.
constexpr double far_beyond = 3, large_part = 0.2;

double largest_way(algebra::Vector before, const algebra::Vector& now) {
  algebra::axpy(-1, now, before);
  return solution::largest_displacement(before);
}

/// Solves with finite rotations, by Newton steps from the state of the shell with the stresses and the zone of `start`.
Found newton_solution(LevelRun& run, finite::StepStart start) {
  assembly::DiscreteShell& discrete = run.discrete();
  solution::NodalSolution nodal =
      solution::nodal_solution(discrete, algebra::Vector(discrete.space().layout, discrete.obstacle_block()));
  finite::NewtonStep step;
  double before = std::numeric_limits<double>::infinity(), predicted = 0;
  bool lost_stiffness = false;
  for (int steps = 0; steps < most_newton_steps; ++steps) {
    step = run.newton_step(start);
    run.is_control_blind = step.is_control_blind;
    lost_stiffness = lost_stiffness || (step.shift > 0 && steps > 0);
    if (steps == 0) predicted = step.largest_displacement;
    if (finite::has_no_minimiser(step.status())) step.box.status = contact::Status::no_equilibrium;
    if (step.status() != contact::Status::solved) break;
    linearise(discrete, finite::next_state(discrete, start, step));
    const double displacement = solution::largest_displacement(discrete.state.displacement);
    start = std::move(step.next);
    const double size =
        std::max(step.largest_rotation, displacement > 0 ? step.largest_displacement / displacement : 0);
    // A slow iteration, as with stiffness that is not symmetric, shrinks its steps by less than a tenth, too.
    const bool is_rounding = size < small_step && size > (size < tiny_step ? 0.9 : 1.0) * before;
    before = size;
    if (size <= negligible_step || (step.shift == 0 && is_rounding)) break;
    if (steps + 1 == most_newton_steps) step.box.status = contact::Status::no_equilibrium;
  }
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
  return discrete.follower_pressure.empty() && discrete.space().bodies.empty() && !discrete.state.control &&
         discrete.shell.sections().most_layers() == 0 && assembly::pressed_obstacles(discrete).empty();
}

/// Descends from the state of the shell towards a local minimum of the potential: Newton steps with the stresses of the state and
/// a stiffness to which a multiple of the diagonal is added until they lower it. Returns the start of the steps that finish, empty if a step
/// failed. Needed where the shell snaps away from an obstacle.
std::optional<finite::StepStart> descended(LevelRun& run) {
  constexpr int most_steps = 200;
  constexpr double near = 1e-2, first_shift = 1e-3, least_shift = 1e-6, largest_shift = 1e2;
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
    if (finite::potential(discrete, weight) < merit) {
      has_descended = true;
      zone = std::move(step.next.zone);
      shift = step.shift / 4 < least_shift ? 0 : step.shift / 4;
      const double whole = solution::largest_displacement(discrete.state.displacement);
      if (shift == 0 && step.largest_displacement < near * whole) break;
    } else {
      linearise(discrete, before);
      shift = std::max(first_shift, 4 * step.shift);
    }
  }
  if (!has_descended) return {};
  return start_with(0);
}

/// Solves with finite rotations; where Newton steps do not come to rest, descends from the state of the shell first.
Found solved_finite(LevelRun& run, const algebra::Vector* zone) {
  assembly::DiscreteShell& discrete = run.discrete();
  const assembly::State before = discrete.state;
  // The stresses of an interpolated state are not used: rotations that do not fit leave a false stretch in it.
  finite::StepStart start{.prestress = finite::no_prestress(discrete)};
  if (zone) start.zone = *zone;
  Found found = newton_solution(run, std::move(start));
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

/// Solves the contact problem of the model, from the state of the shell and an expected zone; null if there is none.
Found met(LevelRun& run, const LevelTask& task, const algebra::Vector* zone, bool detect_free_motions) {
  return run.discrete().has_finite_rotations() ? solved_finite(run, zone)
                                               : solved_linear(run, task, zone, detect_free_motions);
}

/// Solves the contact problem with other lifts of bounds, from a solution's state and contact zone.
Found met_with(algebra::Vector lifts, LevelRun& run, const LevelTask& task, const solution::NodalSolution& before) {
  const ContactTrend trend = contact_trend(run.discrete(), before);
  assembly::State state = run.discrete().state;
  state.positions = run.discrete().positions();
  state.lifts = std::move(lifts);
  linearise(run.discrete(), std::move(state));
  const algebra::Vector expected = expected_zone(run.discrete(), trend);
  return met(run, task, &expected, !supports_hold(run.history, task.settings));
}

struct Lifted {
  int rounds = 0;
  std::optional<double> energy_before{};  ///< [J]
};

/// Lifts bounds until the shell is outside the obstacles also between its nodes. If lifts leave no room for the shell
/// between obstacles, they are undone. The certificate then shows the depth.
Lifted lift_bounds(LevelRun& run, const LevelTask& task, Found& found) {
  assembly::DiscreteShell& discrete = run.discrete();
  if (discrete.obstacles.empty()) return {};
  discrete.state.lifts = algebra::Vector(discrete.space().layout, static_cast<int>(discrete.obstacles.all.size()));
  BoundLifts loop(discrete);
  Lifted lifted;
  while (found.z.status == contact::Status::solved) {
    auto lifts = loop.next(found.nodal);
    if (!lifts) break;
    if (!lifted.energy_before) lifted.energy_before = discrete.energies(found.nodal.y).total();
    algebra::Vector before = discrete.state.lifts;
    Found next = met_with(std::move(*lifts), run, task, found.nodal);
    const bool has_room = next.z.status != contact::Status::infeasible;
    found = has_room ? std::move(next) : met_with(std::move(before), run, task, found.nodal);
    if (!has_room) break;
  }
  lifted.rounds = loop.rounds();
  return lifted;
}

}  // namespace

bool supports_hold(const std::vector<contact::Iteration>& history, const contact::Settings& settings) {
  return &contact::solver_of(settings) == &contact::solve_primal_dual_active_set && !history.empty() &&
         history.front().active == 0 && !history.front().safeguarded;
}

Level measured(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
               const certificate::Verdict& verdict) {
  const fem::Space& space = discrete.space();
  const int width = discrete.coordinates.width + (solution.lambda.layout() ? 1 : 0);
  return {.cells = space.global_cells,
          .nodes = space.layout->global_size,
          .unknowns = width * space.layout->global_size,
          .active = verdict.summary.touching_nodes,
          .gap_error = gap_error(discrete, solution).at_contact,
          .energy = verdict.summary.energy.total(),
          .reaction = verdict.summary.reaction.force.norm(),
          .contact_area = verdict.summary.contact_area,
          .max_normal_rotation = verdict.summary.max_normal_rotation,
          .multiplier_norm = verdict.summary.multiplier_norm,
          .min_gap = verdict.certificate.min_gap_nodes,
          .max_rotation = verdict.summary.max_rotation};
}

LevelResult solve_level(const LevelTask& task, std::unique_ptr<assembly::DiscreteShell> discrete,
                        const Observer& observer) {
  LevelRun run(task, std::move(discrete), observer);
  Found found = met(run, task, task.zone ? &*task.zone : nullptr, true);
  const Lifted lifted = task.admissible ? lift_bounds(run, task, found) : Lifted{};
  contact::BoxSolution& z = found.z;
  solution::NodalSolution& nodal = found.nodal;
  Stopwatch watch;
  run.tell("certificate");
  certificate::Verdict verdict = certificate::certify(run.discrete(), nodal);
  run.seconds.certificate = watch.lap();
  std::optional<estimation::Estimates> estimates;
  std::vector<double> values;
  const bool is_finite = run.discrete().has_finite_rotations();
  contact::BoxSolution duals;
  if (is_finite && z.status == contact::Status::solved && (task.goals || !task.valued.empty()))
    duals = run.prepare_duals(nodal);
  if (task.goals && z.status == contact::Status::solved)
    estimates = run.estimate(is_finite ? duals : z, nodal, verdict.summary);
  std::optional<double> buckling;
  if (z.status == contact::Status::solved) {
    if (!task.valued.empty()) values = run.values(is_finite ? duals : z, nodal, verdict.summary);
    if (task.goals && !is_finite) buckling = run.buckling(z, nodal, verdict.summary);
  }

  Level record = record_of(measured(run.discrete(), nodal, verdict), z);
  record.buckling = buckling;
  record.iterations = static_cast<int>(run.history.size());
  record.history = std::move(run.history);
  record.factorisations = run.factorisations;
  record.linearisations = run.linearisations;
  record.has_jumped = run.has_jumped;
  record.is_control_blind = run.is_control_blind;
  record.lift_rounds = lifted.rounds;
  record.energy_before_lifts = lifted.energy_before.value_or(record.energy);
  record.seconds = run.seconds;
  Solution solution{.discrete = run.take(), .nodal = std::move(nodal), .entered = std::move(verdict.entered)};
  if (estimates) solution.cell_errors = estimates->cells;
  return {std::move(record), std::move(solution), std::move(verdict), std::move(estimates), std::move(values)};
}

}  // namespace plastron::computation

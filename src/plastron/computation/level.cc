#include <plastron/computation/level.hpp>

#include <plastron/computation/bound_lifts.hpp>
#include <plastron/computation/contact_forecast.hpp>
#include <plastron/computation/finite_solution.hpp>
#include <plastron/computation/relinearisation.hpp>
#include <plastron/computation/resources.hpp>
#include <plastron/computation/unpressed.hpp>
#include <plastron/contact/solve.hpp>

namespace plastron::computation {

namespace {

/// Adds the solver's data to the measures of a level.
Level record_of(Level level, const contact::BoxSolution& z) {
  level.status = z.status;
  level.linear_residual = z.linear_residual;
  level.tolerances = z.tolerances;
  return level;
}

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

/// Solves the contact problem of the model, from the state of the shell and an expected zone; null if there is none.
Found met(LevelRun& run, const LevelTask& task, const algebra::Vector* zone, bool detect_free_motions) {
  return run.discrete().has_increments() ? solved_finite(run, zone)
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

/// Solves again with the obstacles whose force is 0, where the solution leaves them. Nothing changes but their gaps.
Found met_beside(const std::vector<std::size_t>& unpressed, LevelRun& run, const LevelTask& task,
                 const solution::NodalSolution& before) {
  const ContactTrend trend = contact_trend(run.discrete(), before);
  put_back(run.discrete(), unpressed, before.y);
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
          .time = discrete.state.factors.time,
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
  const std::vector<std::size_t> unpressed = unpressed_obstacles(run.discrete());
  if (!unpressed.empty()) release(run.discrete(), unpressed);
  Found found = met(run, task, task.zone ? &*task.zone : nullptr, true);
  if (!unpressed.empty() && found.z.status == contact::Status::solved)
    found = met_beside(unpressed, run, task, found.nodal);
  const Lifted lifted = task.admissible ? lift_bounds(run, task, found) : Lifted{};
  contact::BoxSolution& z = found.z;
  solution::NodalSolution& nodal = found.nodal;
  Stopwatch watch;
  run.tell("certificate");
  certificate::Verdict verdict = certificate::certify(run.discrete(), nodal);
  run.seconds.certificate = watch.lap();
  std::optional<estimation::Estimates> estimates;
  std::vector<double> values;
  std::optional<double> buckling;
  if (z.status == contact::Status::solved && (task.goals || !task.valued.empty())) {
    const contact::BoxSolution duals = run.prepare_duals(z, nodal);
    if (task.goals) estimates = run.estimate(duals, nodal, verdict.summary);
    if (!task.valued.empty()) values = run.values(duals, nodal, verdict.summary);
  }
  if (z.status == contact::Status::solved && (task.goals || task.judges_buckling) &&
      run.discrete().has_linear_strains())
    buckling = run.buckling(z, nodal, verdict.summary);

  Level record = record_of(measured(run.discrete(), nodal, verdict), z);
  record.buckling = buckling;
  record.iterations = static_cast<int>(run.history.size());
  record.history = std::move(run.history);
  record.factorisations = run.factorisations;
  record.linearisations = run.linearisations;
  record.has_jumped = run.has_jumped;
  record.has_lost_stiffness = run.has_lost_stiffness;
  record.is_control_blind = run.is_control_blind;
  record.lift_rounds = lifted.rounds;
  record.energy_before_lifts = lifted.energy_before.value_or(record.energy);
  record.seconds = run.seconds;
  Solution solution{
      .discrete = run.take(), .nodal = std::move(nodal), .box = std::move(z), .entered = std::move(verdict.entered)};
  if (estimates) solution.cell_errors = estimates->cells;
  return {.record = std::move(record),
          .solution = std::move(solution),
          .verdict = std::move(verdict),
          .estimates = std::move(estimates),
          .values = std::move(values)};
}

}  // namespace plastron::computation

// The whole computation:
//   find U in K with a(U, V - U) >= l(V - U) for all V in K              (M17, M18), without obstacle (M11)
// on a sequence of nested meshes. On each mesh the nodal coordinates make K a box. The active set of the previous mesh
// is the first guess, and the finest solution is certified from its strains and bounds. With steps, the finest mesh is
// used for all of them, and each part of a step starts from the previous one. If an obstacle could pass through the
// shell between two instants, intermediate instants are solved.
#include <plastron/computation/solve.hpp>

#include <plastron/computation/adaptivity.hpp>
#include <plastron/computation/approach.hpp>
#include <plastron/computation/meshes.hpp>
#include <plastron/computation/step_control.hpp>
#include <plastron/estimation/goal_record.hpp>
#include <plastron/problem/goal_names.hpp>

#include <fmt/format.h>

#include <utility>

namespace plastron::computation {

namespace {

/// Returns the contact expected at an instant. Within a step the trend of contact is expected to continue.
ContactTrend expected_contact(Run& run, const problem::Instant& instant) {
  ContactTrend now = contact_trend(*run.solution().discrete, run.solution().nodal);
  const std::optional<PreviousInstant> before = std::exchange(run.before, {});
  if (!run.at) return now;
  run.before = PreviousInstant{run.at->time, now};
  if (!before || run.at->step != instant.step || before->time < run.at->step) return now;
  return continued(std::move(now), before->trend, (instant.time - run.at->time) / (run.at->time - before->time));
}

/// Judges the accuracy at the last instant. The steps may lead to another solution than the one for which the mesh was
/// made.
void judge_accuracy_at_end(Run& run, Meshes& meshes, const problem::Instant& instant) {
  const estimation::Estimates& estimates = *run.result.estimates;
  if (!meshes.are_ahead() && wants_witness(run.problem, meshes.space(), estimates, run.result.summary))
    meshes.confirm(instant);
  const auto goals = estimation::goal_records(problem::estimated_goals(run.problem), estimates, run.result.summary);
  const std::string missed = estimation::shortfall(goals, estimates);
  if (missed.empty()) return;
  run.missed_accuracy +=
      fmt::format("{}at the last instant, reached step by step, {}", run.missed_accuracy.empty() ? "" : "; ", missed);
}

/// Solves an instant on the finest mesh from a state with the contact that is expected, and records it unless a shorter part of
/// the step is to be tried.
Attempt attempted(Run& run, Meshes& meshes, const problem::Instant& instant, assembly::State start,
                  const ContactTrend& expected, double part) {
  Stopwatch watch;
  LevelTask task = run.task_after_first_level(run.problem.discretisation.refinements);
  if (&instant == &run.instants.back() && !instant.control) task.goals = run.goals();
  auto discrete = run.relinearised(std::move(start), expected, task);
  task.seconds.discretisation = watch.lap();
  LevelResult level = solve_level(task, std::move(discrete), run.observer);
  run.result.status = level.record.status;
  Attempt attempt = judged(level.record, part);
  if (run.result.status == contact::Status::interrupted) return attempt;
  if (!attempt.is_accepted && attempt.may_go_on) {
    run.result.solution = std::move(level.solution);
    return attempt;
  }
  run.take(std::move(level));
  if (run.problem.accuracy && run.result.estimates) judge_accuracy_at_end(run, meshes, instant);
  run.record(instant);
  attempt.may_go_on = run.result.status == contact::Status::solved || run.result.status == contact::Status::inaccurate;
  return attempt;
}

/// Solves an instant from a state and the contact zone of the solution at hand, and records it.
bool advance(Run& run, Meshes& meshes, const problem::Instant& instant, assembly::State start) {
  if (run.is_interrupted()) return false;
  const ContactTrend expected = expected_contact(run, instant);
  return attempted(run, meshes, instant, std::move(start), expected, 0).may_go_on;
}

/// Goes from the instant of the solution at hand to the next one.
bool advance(Run& run, Meshes& meshes, const problem::Instant& before, const problem::Instant& next) {
  if (!next.chooses_parts)
    return run.has_time_for(next) && approach(run, before, next) && advance(run, meshes, next, run.continued_at(next));
  return go_in_parts(run, before, next, [&](const problem::Instant& instant, const Departure& departure, double part) {
    return attempted(run, meshes, instant, run.state_at(instant, departure), departure.trend, part);
  });
}

/// Records the first instant of the finest mesh; solves it again if the last instant was solved there.
bool record_first(Run& run, Meshes& meshes) {
  const problem::Instant& first = run.instants.front();
  if (&meshes.instant() == &first) {
    run.record(first);
    return run.result.status != contact::Status::no_equilibrium;
  }
  auto discrete = std::move(run.solution().discrete);
  if (!approach_from_start(run, discrete, first)) return false;
  const bool starts_anew = discrete != nullptr;
  if (starts_anew) run.solution().discrete = std::move(discrete);
  if (!advance(run, meshes, first, starts_anew ? run.state_at(first) : run.continued_at(first))) return false;
  // The iteration started from the contact of the last instant: its way is not that of the loading.
  run.result.history.back().level.has_jumped = false;
  return true;
}

}  // namespace

Result solve(const problem::Problem& problem, MPI_Comm comm, const Observer& observer) {
  Run run(problem, comm, observer);
  Meshes meshes(run);
  bool goes_on = meshes.solve();
  if (goes_on && !problem.steps.empty()) goes_on = record_first(run, meshes);
  for (std::size_t i = 1; goes_on && i < run.instants.size(); ++i)
    goes_on = advance(run, meshes, run.instants[i - 1], run.instants[i]);
  if (goes_on) meshes.judge_geometry();
  if (goes_on && problem.steps.empty() && !run.has_checked_model()) run.check_model();
  return run.finish();
}

}  // namespace plastron::computation

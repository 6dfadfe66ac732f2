// The whole computation:
//   find U in K with a(U, V - U) >= l(V - U) for all V in K              (M17, M18), without obstacle (M11)
// on a sequence of nested meshes. On each mesh the nodal coordinates make K a box. The active set of the previous mesh
// is the first guess, and the finest solution is certified from its strains and bounds. With steps, each part of a step
// starts from the previous one, on its mesh; with an accuracy, further meshes follow the shell. If an obstacle could pass
// through the shell between two instants, intermediate instants are solved.
#include <plastron/computation/solve.hpp>

#include <plastron/computation/approach.hpp>
#include <plastron/computation/meshes.hpp>

#include <utility>

namespace plastron::computation {

namespace {

/// Solves an instant on the present mesh from a departure, and records it unless a shorter part of the step is to be tried.
Attempt attempted(Run& run, Meshes& meshes, const problem::Instant& instant, const Departure& departure, double part,
                  const Pace& pace) {
  Stopwatch watch;
  LevelTask task = run.task_after_first_level(run.problem.discretisation.refinements);
  task.leaves_unstable = !instant.control;
  const bool is_judged = run.problem.accuracy || &instant == &run.instants.back();
  if (is_judged && !instant.control) task.goals = run.goals();
  task.judges_buckling = instant.part == 1;
  auto discrete = run.relinearised(run.state_at(instant, departure), departure.trend, task);
  task.seconds.discretisation = watch.lap();
  LevelResult level = solve_level(task, std::move(discrete), run.observer);
  run.search_path(level);
  run.result.status = level.record.status;
  Attempt attempt = judged(level, part, pace);
  if (run.result.status == contact::Status::interrupted) return {};
  if (!attempt.is_accepted && attempt.may_go_on) {
    run.result.solution = std::move(level.solution);
    return attempt;
  }
  if (level.record.has_jumped) meshes.begin_again(instant, task, level);
  run.take(std::move(level));
  if (run.result.estimates && !meshes.reach_accuracy(instant) && run.result.status == contact::Status::interrupted)
    return {};
  run.record(instant);
  attempt.may_go_on = run.result.status == contact::Status::solved || run.result.status == contact::Status::inaccurate;
  return attempt;
}

/// Goes from the instant of the solution at hand to the next one.
bool advance(Run& run, Meshes& meshes, const problem::Instant& before, const problem::Instant& next) {
  const Pace pace = pace_of(next);
  return approach(run, before, next, [&](const problem::Instant& instant, const Departure& departure, double part) {
    return attempted(run, meshes, instant, departure, part, pace);
  });
}

/// Solves a load case by itself, from the undeformed shell, with the mesh, the factor and the contact zone at hand.
bool solve_case(Run& run, Meshes& meshes, const problem::Instant& instant) {
  Stopwatch watch;
  LevelTask task = run.task_after_first_level(run.problem.discretisation.refinements);
  if (run.problem.accuracy || &instant == &run.instants.back()) task.goals = run.goals();
  task.judges_buckling = true;
  const ContactTrend expected = run.expected_contact(nullptr);
  auto discrete = run.relinearised(run.state_at(instant), expected, task);
  task.seconds.discretisation = watch.lap();
  run.take(solved_from_start(run, instant, task, std::move(discrete)));
  if (run.result.estimates && !meshes.reach_accuracy(instant)) return false;
  run.record(instant);
  return run.result.status != contact::Status::interrupted;
}

}  // namespace

Result solve(const problem::Problem& problem, MPI_Comm comm, const Observer& observer) {
  Run run(problem, comm, observer);
  Meshes meshes(run);
  bool goes_on = meshes.solve();
  if (goes_on && !problem.steps.empty()) {
    run.record(run.instants.front());
    goes_on = problem.steps_are_cases || run.result.status != contact::Status::no_equilibrium;
  }
  for (std::size_t i = 1; goes_on && i < run.instants.size(); ++i)
    goes_on = problem.steps_are_cases ? solve_case(run, meshes, run.instants[i])
                                      : advance(run, meshes, run.instants[i - 1], run.instants[i]);
  if (goes_on) meshes.judge_geometry();
  if (goes_on && problem.steps.empty() && !run.has_checked_model()) run.check_model();
  return run.finish();
}

}  // namespace plastron::computation

#include <plastron/computation/approach.hpp>

#include <plastron/computation/evaluation.hpp>
#include <plastron/computation/passage.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plastron::computation {

namespace {

/// Warns that an instant on the way has no solution, or one that misses a limit.
void tell_missed(Run& run, const problem::Instant& instant) {
  if (run.missed_between.empty())
    run.missed_between = fmt::format("on the way to time {:g}: {}", instant.time, status_text(run.result));
  run.warn({run.missed_between});
}

/// Solves an intermediate instant whose results are not requested.
bool solve_between(Run& run, const problem::Instant& instant, const LevelTask& task,
                   std::unique_ptr<assembly::DiscreteShell> discrete) {
  Result& result = run.result;
  LevelResult level = solve_level(task, std::move(discrete), run.observer);
  result.status = level.record.status;
  if (result.status == contact::Status::interrupted) return false;
  if (result.levels.empty() && result.status != contact::Status::solved) result.levels.push_back(level.record);
  run.take(std::move(level));
  run.before.reset();
  judge_certificate(result);
  if (result.status == contact::Status::solved) return true;
  tell_missed(run, instant);
  return result.status == contact::Status::inaccurate;
}

/// The same, from the solution at hand.
bool solve_between(Run& run, const problem::Instant& instant) {
  LevelTask task = run.task(run.last_level());
  auto discrete =
      run.relinearised(run.continued_at(instant), contact_trend(*run.solution().discrete, run.solution().nodal), task);
  return solve_between(run, instant, task, std::move(discrete));
}

}  // namespace

bool approach(Run& run, const problem::Instant& from, const problem::Instant& to, double done) {
  for (;;) {
    done = next_part(*run.solution().discrete, run.solution().nodal.y, from, to, done);
    if (done == 1) return true;
    if (run.is_interrupted() || !solve_between(run, problem::between(from, to, done))) return false;
  }
}

bool approach_from_start(Run& run, std::unique_ptr<assembly::DiscreteShell>& discrete, const problem::Instant& to) {
  if (run.problem.steps.empty()) return true;
  const problem::Instant start = problem::start(run.problem);
  const double first = next_part(*discrete, algebra::Vector(discrete->space().layout, 6), start, to, 0);
  if (first == 1) return true;
  const problem::Instant instant = problem::between(start, to, first);
  linearise(*discrete, run.state_at(instant));
  return solve_between(run, instant, run.task(run.last_level()), std::move(discrete)) &&
         approach(run, start, to, first);
}

}  // namespace plastron::computation

#include <plastron/computation/approach.hpp>

#include <plastron/computation/evaluation.hpp>
#include <plastron/computation/passage.hpp>
#include <plastron/computation/step_control.hpp>

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

/// Goes to an instant in parts that are chosen, without results.
bool choose_parts_between(Run& run, const problem::Instant& from, const problem::Instant& to) {
  const auto solve = [&](const problem::Instant& instant, const Departure& departure, double part) {
    LevelTask task = run.task(run.last_level());
    auto discrete = run.relinearised(run.state_at(instant, departure), departure.trend, task);
    LevelResult level = solve_level(task, std::move(discrete), run.observer);
    const Attempt attempt = judged(level.record, part);
    run.result.status = level.record.status;
    if (attempt.is_accepted || (!attempt.may_go_on && level.record.status != contact::Status::interrupted))
      run.take(std::move(level));
    else
      run.result.solution = std::move(level.solution);
    return attempt;
  };
  if (go_in_parts(run, from, to, solve)) return true;
  using enum contact::Status;
  const contact::Status status = run.result.status;
  if (status != interrupted && status != solved && status != inaccurate) tell_missed(run, to);
  return false;
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

bool approach_last(Run& run) {
  const std::vector<problem::Instant>& instants = run.instants;
  // With finite rotations the way decides which of several solutions is found.
  const bool depends_on_way = run.problem.shell.rotations == element::Rotations::finite;
  if (!depends_on_way &&
      !may_pass(*run.solution().discrete, run.solution().nodal.y, instants.front().time, instants.back().time))
    return true;
  for (std::size_t i = 1; i < instants.size(); ++i) {
    if (instants[i].chooses_parts) {
      if (!choose_parts_between(run, instants[i - 1], instants[i])) return false;
      continue;
    }
    if (!approach(run, instants[i - 1], instants[i])) return false;
    if (i + 1 < instants.size() && !solve_between(run, instants[i])) return false;
  }
  return true;
}

}  // namespace plastron::computation

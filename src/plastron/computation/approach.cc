#include <plastron/computation/approach.hpp>

#include <plastron/computation/evaluation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace plastron::computation {

namespace {

using enum contact::Status;

/// Warns that an instant on the way has no solution, or one that misses a limit.
void tell_missed(Run& run, const problem::Instant& instant) {
  if (run.missed_between.empty())
    run.missed_between = fmt::format("on the way to time {:g}: {}", instant.factors.time, status_text(run.result));
  run.warn({run.missed_between});
}

/// Solves an instant on the way whose results are not requested.
Attempt attempted_between(Run& run, const problem::Instant& instant, const Departure& departure, double part,
                          const Pace& pace) {
  LevelTask task = run.task(run.last_level());
  task.leaves_unstable = !instant.control;
  auto discrete = run.relinearised(run.state_at(instant, departure), departure.trend, task);
  LevelResult level = solve_level(task, std::move(discrete), run.observer);
  run.search_path(level);
  Attempt attempt = judged(level, part, pace);
  run.result.status = level.record.status;
  if (run.result.status == interrupted) return {};
  if (!attempt.is_accepted && attempt.may_go_on) {
    run.result.solution = std::move(level.solution);
    return attempt;
  }
  run.take(std::move(level));
  run.before.reset();
  judge_certificate(run.result);
  if (run.result.status != solved) tell_missed(run, instant);
  attempt.may_go_on = run.result.status == solved || run.result.status == inaccurate;
  return attempt;
}

/// Whether one part from the undeformed shell does not show where the path leads.
bool needs_parts(const LevelResult& level) {
  const Level& record = level.record;
  if (record.status == interrupted) return false;
  if (level.passes) return true;
  if (!level.solution.discrete->depends_on_path()) return false;
  return record.has_jumped || record.has_lost_stiffness || (record.status != infeasible && record.status != solved);
}

}  // namespace

std::optional<LevelResult> solved_in_parts(Run& run, const problem::Instant& to, const LevelTask& task,
                                           std::unique_ptr<assembly::DiscreteShell> discrete, const Pace& pace) {
  const problem::Instant start = problem::start(run.problem);
  run.rest_at(start, std::move(discrete));
  std::optional<LevelResult> last;
  bool has_jumped = false;
  const auto solve = [&](const problem::Instant& instant, const Departure& departure, double part) {
    LevelTask now = &instant == &to ? task : run.task(run.last_level());
    if (&instant != &to) now.admissible = false;
    now.leaves_unstable = task.leaves_unstable;
    LevelResult level =
        solve_level(now, run.relinearised(run.state_at(instant, departure), departure.trend, now), run.observer);
    run.search_path(level);
    const Attempt attempt = judged(level, part, pace);
    if (level.record.status == interrupted || (attempt.is_accepted && level.passes)) return Attempt{};
    has_jumped = has_jumped || (attempt.is_accepted && level.record.has_jumped);
    level.record.has_jumped = has_jumped;
    if (attempt.is_accepted && &instant == &to)
      last = std::move(level);
    else if (attempt.is_accepted)
      run.take(std::move(level));
    else
      run.result.solution = std::move(level.solution);
    return attempt;
  };
  const problem::Instant* from = &start;
  for (const problem::Instant& next : run.instants) {
    if (run.problem.steps_are_cases || !(next.factors.time < to.factors.time)) break;
    if (!go_in_parts(run, *from, next, pace_of(next), solve)) return {};
    from = &next;
  }
  go_in_parts(run, *from, to, pace, solve);
  return last;
}

LevelResult solved_from_start(Run& run, const problem::Instant& to, LevelTask task,
                              std::unique_ptr<assembly::DiscreteShell> discrete) {
  const problem::Instant start = problem::start(run.problem);
  run.path.restart();
  const auto in_parts = [&](const assembly::DiscreteShell& shell, double part) {
    Pace pace = from_start;
    pace.first = part;
    auto level = solved_in_parts(run, to, task, std::make_unique<assembly::DiscreteShell>(shell), pace);
    if (!level) run.path.restart();
    return level;
  };
  const double first = next_part(*discrete, algebra::Vector(discrete->space().layout, 6), start, to, 0);
  if (first < 1)
    if (auto level = in_parts(*discrete, first)) return std::move(*level);
  LevelResult direct = solve_level(task, std::move(discrete), run.observer);
  run.search_path(direct);
  if (first == 1 && needs_parts(direct))
    if (auto level = in_parts(*direct.solution.discrete, from_start.first)) return std::move(*level);
  return direct;
}

bool approach(Run& run, const problem::Instant& from, const problem::Instant& to, const Solve& solve) {
  const Pace pace = pace_of(to);
  return go_in_parts(
      run, from, to, pace, [&](const problem::Instant& instant, const Departure& departure, double part) {
        const bool is_asked = &instant == &to || to.chooses_parts;
        return is_asked ? solve(instant, departure, part) : attempted_between(run, instant, departure, part, pace);
      });
}

}  // namespace plastron::computation

#include <plastron/computation/approach.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/computation/evaluation.hpp>
#include <plastron/computation/step_control.hpp>
#include <plastron/obstacle/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plastron::computation {

namespace {

using Eigen::Vector3d;

/// Part of the thickness that any obstacle may move in one step.
constexpr double short_way = 0.25;

/// An obstacle before and after its motion, and the displacement of its points.
struct Moving {
  obstacle::Obstacle before, after;

  Vector3d way(const Vector3d& X) const { return after.placement.to_space(before.placement.to_body(X)) - X; }
};

/// `X`: place of the node's mid-surface now, `a3`: the shell's direction there.
bool may_pass_at(const Moving& moving, const assembly::NodalPoint& point, const Vector3d& X, const Vector3d& a3) {
  // Size of the region around the node: an obstacle may be smaller than the distance of nodes.
  const double around = 2 * std::sqrt(point.weight) + point.thickness / 2, way = moving.way(X).norm();
  if (way <= short_way * point.thickness) return false;
  const obstacle::Nearest first = moving.before.nearest(X);
  if (first.distance - way > around) return false;
  const obstacle::Nearest last = moving.after.nearest(X);
  return (first.distance + last.distance - way) / 2 <= around && first.normal.dot(a3) * last.normal.dot(a3) <= 0;
}

/// Whether an obstacle that moves from one time to another changes sides of the shell. The shell rests at `y`, and the
/// obstacle is near enough to touch it. It would face one side of the shell before and the other side after. For
/// motions below a quarter of the thickness, the shell's fibres find the correct side (obstacle/gap.hpp) (collective).
/// Throws ObstacleError.
bool may_pass(const assembly::DiscreteShell& discrete, const algebra::Vector& y, double from, double to) {
  const MPI_Comm comm = discrete.space().layout->comm;
  bool may = false;
  algebra::in_agreement<obstacle::ObstacleError>(comm, [&] {
    for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) {
      const obstacle::Obstacle& obstacle = discrete.obstacles_at_start.all[k];
      if (obstacle.motions.empty() || obstacle.is_plane()) continue;
      const double position = discrete.state.position(k) + discrete.way_pressed(k);
      const Moving moving{obstacle.standing(from, position), obstacle.standing(to, position)};
      for (std::size_t i = 0; !may && i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
        const assembly::Vector6 now = assembly::node_values(y, i);
        Vector3d a3 = discrete.points[i].a3;
        if (discrete.has_finite_rotations()) a3 += now.tail<3>();
        may = may_pass_at(moving, discrete.points[i], discrete.points[i].phi + now.head<3>(), a3);
      }
    }
  });
  return algebra::sum_over_ranks(std::int64_t{may}, comm) > 0;
}

/// Returns the next part of the way between two instants, after `done`. It is so short that obstacles cannot pass
/// through the shell at `y`.
double next_part(const assembly::DiscreteShell& discrete, const algebra::Vector& y, const problem::Instant& from,
                 const problem::Instant& to, double done) {
  constexpr double least = 0x1p-10;
  const auto time = [&](double part) { return problem::between(from, to, part).time; };
  double next = 1;
  while (next - done > least && may_pass(discrete, y, time(done), time(next))) next = done + (next - done) / 2;
  return next;
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
  if (run.missed_between.empty())
    run.missed_between =
        fmt::format("at time {:g}, on the way of the moving obstacles: {}", instant.time, status_text(result));
  run.warn({run.missed_between});
  return result.status == contact::Status::inaccurate;
}

/// Goes to an instant in parts that are chosen, without results.
bool choose_parts_between(Run& run, const problem::Instant& from, const problem::Instant& to) {
  return go_in_parts(run, from, to, [&](const problem::Instant& instant, const Departure& departure, double part) {
    LevelTask task = run.task(run.last_level());
    auto discrete = run.relinearised(run.state_at(instant, departure), departure.trend, task);
    LevelResult level = solve_level(task, std::move(discrete), run.observer);
    const Attempt attempt = judged(level.record, part);
    run.result.status = level.record.status;
    if (attempt.is_accepted)
      run.take(std::move(level));
    else
      run.result.solution = std::move(level.solution);
    return attempt;
  });
}

/// The same, from the solution at hand.
bool solve_between(Run& run, const problem::Instant& instant) {
  LevelTask task = run.task(run.last_level());
  auto discrete =
      run.relinearised(run.continued_at(instant), contact_trend(*run.solution().discrete, run.solution().nodal), task);
  return solve_between(run, instant, task, std::move(discrete));
}

}  // namespace

double next_part(const Run& run, const problem::Instant& from, const problem::Instant& to, double done) {
  return next_part(*run.solution().discrete, run.solution().nodal.y, from, to, done);
}

bool approach(Run& run, const problem::Instant& from, const problem::Instant& to, double done) {
  for (;;) {
    done = next_part(run, from, to, done);
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

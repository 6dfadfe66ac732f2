#include <plastron/computation/run.hpp>

#include <plastron/computation/evaluation.hpp>
#include <plastron/computation/model_check.hpp>
#include <plastron/computation/warnings.hpp>
#include <plastron/finite/modes.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/problem/goal_names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plastron::computation {

Run::Run(const problem::Problem& p, MPI_Comm c, const Observer& asked)
    : problem(p), comm(c), observer(asked), instants(problem::instants(p)), asked_(asked) {
  if (p.accuracy && !std::isinf(p.accuracy->max_seconds))
    observer.stop = [this] { return (asked_.stop && asked_.stop()) || since_start.seconds() > end_of_meshes; };
  result.has_obstacle = !p.shell.obstacles.empty();
  result.formulation = p.shell.tangency.formulation;
  result.rotations = p.shell.rotations;
  result.warnings = locking_warnings(p);
  MPI_Comm_size(comm, &result.ranks);
}

bool Run::is_interrupted() {
  if (!wants_to_stop(observer, comm)) return false;
  result.status = contact::Status::interrupted;
  return true;
}

bool Run::is_out_of_time() const {
  return result.status == contact::Status::interrupted && !std::isinf(end_of_meshes) && result.solution &&
         !wants_to_stop(asked_, comm);
}

bool Run::is_time_over() const {
  return problem.accuracy && algebra::max_over_ranks(since_start.seconds(), comm) > problem.accuracy->max_seconds;
}

bool Run::has_time_for(const problem::Instant& instant) {
  if (!is_time_over()) return true;
  missed_accuracy += fmt::format("{}max_seconds = {:g} was over before time {:g}", missed_accuracy.empty() ? "" : "; ",
                                 problem.accuracy->max_seconds, instant.factors.time);
  if (at) missed_accuracy += fmt::format(", and the result is that of time {:g}", at->factors.time);
  return false;
}

std::vector<estimation::Goal> Run::goals() const {
  if (problem.accuracy) return problem::estimated_goals(problem);
  std::vector<estimation::Goal> goals{{"energy", estimation::Energy{}}};
  if (!problem.shell.obstacles.empty()) goals.push_back({"reaction", estimation::ObstacleForce{}});
  return goals;
}

LevelTask Run::task(int number) const {
  return {.number = number,
          .settings = problem.contact,
          .linearisation = problem.linearisation,
          .admissible = problem.admissible};
}

LevelTask Run::task_after_first_level(int number) const {
  LevelTask next = task(number);
  const auto has_released = [](const problem::Instant& instant) {
    return std::ranges::any_of(instant.factors.released, [](char is_released) { return is_released != 0; });
  };
  if (supports_hold(result.levels.front().history, problem.contact) && std::ranges::none_of(instants, has_released))
    next.settings.detect_free_motions = false;
  return next;
}

assembly::State Run::state_at(const problem::Instant& instant) const {
  assembly::State state{.factors = instant.factors};
  if (!instant.control) return state;
  const auto probe = std::ranges::find(before_step_, instant.control->probe, &ProbeValue::name);
  const double start = probe == before_step_.end() ? 0 : instant.control->direction.dot(probe->values.u);
  state.control = problem::control_of(problem, instant, start);
  const int name = state.control->factor;
  state.factors.controlled(name) = 0;
  if (result.solution && result.solution->discrete) {
    energy::Factors last = result.solution->discrete->state.factors;
    if (!last.named.empty() || name < 0) state.factors.controlled(name) = last.controlled(name);
  }
  return state;
}

assembly::State Run::continued_at(const problem::Instant& instant) const {
  assembly::State start = state_at(instant);
  start.positions = positions();
  if (solution().discrete->state.is_deformed()) start.displacement = solution().nodal.y;
  return start;
}

assembly::State Run::state_at(const problem::Instant& instant, const Departure& departure) const {
  assembly::State start = state_at(instant);
  start.positions = departure.state.positions;
  start.displacement = departure.state.displacement;
  if (start.control) {
    energy::Factors last = departure.state.factors;
    start.factors.controlled(start.control->factor) = last.controlled(start.control->factor);
  }
  if (instant.overlap > 0 && depths_.layout()) {
    start.lifts = depths_;
    for (double& lift : start.lifts.local()) lift *= instant.overlap;
  }
  return start;
}

std::vector<double> Run::positions() const {
  return problem.shell.obstacles.are_linear ? std::vector<double>{} : solution().discrete->positions();
}

std::unique_ptr<assembly::DiscreteShell> Run::relinearised(assembly::State state, const ContactTrend& expected,
                                                           LevelTask& task) {
  auto discrete = std::move(solution().discrete);
  result.solution.reset();
  linearise(*discrete, std::move(state));
  task.zone = expected_zone(*discrete, expected);
  return discrete;
}

ContactTrend Run::expected_contact(const problem::Instant* later) {
  ContactTrend now = contact_trend(*solution().discrete, solution().nodal);
  if (!later) return now;
  const std::optional<PreviousInstant> earlier = std::exchange(before, {});
  if (!at) return now;
  before = PreviousInstant{at->factors.time, now};
  if (!earlier || at->step != later->step || earlier->time < at->step) return now;
  return continued(std::move(now), earlier->trend,
                   (later->factors.time - at->factors.time) / (at->factors.time - earlier->time));
}

void Run::rest_at(const problem::Instant& start, std::unique_ptr<assembly::DiscreteShell> discrete) {
  linearise(*discrete, state_at(start));
  const auto& layout = discrete->space().layout;
  const algebra::Vector none(layout, discrete->obstacle_block());
  depths_ = none;
  for (std::size_t k = 0; k < discrete->coordinates.gaps.size(); ++k)
    for (std::size_t i = 0; i < discrete->coordinates.gaps[k].size(); ++i)
      depths_.at(i)[k] = std::min(0.0, discrete->coordinates.gaps[k][i].initial);
  if (algebra::max_abs(depths_) == 0) depths_ = {};
  result.solution = Solution{.discrete = std::move(discrete),
                             .nodal = {.y = algebra::Vector(layout, 6), .pressure = none, .touching = none}};
}

void Run::search_path(LevelResult& level) {
  using enum contact::Status;
  const assembly::DiscreteShell& discrete = *level.solution.discrete;
  if (!has_path_to_prove(discrete.obstacles)) return;
  if (level.record.status != solved && level.record.status != inaccurate) return;
  if (path.is_broken) {
    level.passing = result.passing;
    level.solution.crossed = path.crossed;
    return;
  }
  Stopwatch watch;
  const certificate::Station now = station_of(discrete, level.solution.nodal.y);
  const std::vector<certificate::Crossing> found = path.crossings_to(discrete, now);
  level.passing = passing_of(discrete, found, path.stations().back().time, now.time);
  level.passes = level.passing->cells > 0;
  for (const certificate::Crossing& crossing : found) level.solution.crossed.push_back(crossing.cell);
  level.record.seconds.certificate += watch.lap();
}

void Run::take(LevelResult level) {
  if (!level.passing) search_path(level);
  result.passing = level.passing;
  if (level.passes) path.break_at(level.solution.crossed);
  if (level.passing && !path.is_broken)
    path.extend(*level.solution.discrete, station_of(*level.solution.discrete, level.solution.nodal.y));
  result.status = level.record.status;
  result.summary = level.verdict.summary;
  take_moments_about(problem.output.moment_point, result.summary);
  result.certificate = level.verdict.certificate;
  latest_ = std::move(level.record);
  has_jumped_ = has_jumped_ || latest_.has_jumped;
  result.solution = std::move(level.solution);
  result.estimates = std::move(level.estimates);
}

void Run::check_model(double time) {
  if (!problem.checks_model || problem.shell.rotations == element::Rotations::finite) return;
  if (result.status != contact::Status::solved && result.status != contact::Status::inaccurate) return;
  Stopwatch watch;
  ModelCheck check{.status = contact::Status::infeasible};
  contact::Settings settings = task_after_first_level(last_level()).settings;
  settings.solver = nullptr;  // others need a definite matrix
  try {
    check = computation::check_model(solution(), result.summary, settings, observer);
  } catch (const assembly::SupportError&) {  // the deformed shell has no box: the check ends without a solution
  } catch (const obstacle::ObstacleError&) {
  }
  // At rest the models agree. A motion without stiffness is then one that nothing holds.
  if (is_at_rest(result.summary) && !(check.status == contact::Status::solved && check.is_stable)) return;
  check.seconds = watch.lap();
  check.time = time;
  check.relative_displacement = checked_displacement_ = result.summary.max_relative_displacement;
  check.rotation = result.summary.max_rotation;
  const auto badness = [](const ModelCheck& c) {
    return std::pair(c.status == contact::Status::solved ? (c.is_stable ? 0 : 1) : 2, c.largest());
  };
  if (!result.model || badness(check) >= badness(*result.model)) result.model = std::move(check);
}

bool Run::has_checked_model() {
  if (!result.model) return false;
  if (carry_to_finer_mesh(result.summary, *result.model)) return true;
  result.model.reset();
  return false;
}

void Run::give_up_modes(Mode::Kind kind) {
  if (!is_time_over() || wants_to_stop(asked_, comm)) {
    result.status = contact::Status::interrupted;
    return;
  }
  const std::string text =
      fmt::format("max_seconds = {:g} was over before the {} were found", problem.accuracy->max_seconds,
                  kind == Mode::Kind::buckling ? "buckling loads" : "natural frequencies");
  if (result.status == contact::Status::solved)
    missed_accuracy += (missed_accuracy.empty() ? "" : "; ") + text;
  else
    warn({text});
}

void Run::find_modes() {
  using enum contact::Status;
  if (result.status != solved && result.status != inaccurate && result.status != unstable) return;
  const auto stop = [&] { return wants_to_stop(asked_, comm) || is_time_over(); };
  const auto find = [&](Mode::Kind kind, int count, const auto& modes_of) {
    if (count == 0 || result.status == interrupted) return;
    finite::Modes found;
    found.was_stopped = stop();
    if (!found.was_stopped) found = modes_of(*solution().discrete, solution().nodal, count, stop);
    if (found.was_stopped) return give_up_modes(kind);
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      const Mode mode{.kind = kind, .number = static_cast<int>(i) + 1, .value = found.values[i]};
      result.modes.push_back(mode);
      solution().modes.push_back(mode);
      solution().modes.back().shape = std::move(found.shapes[i]);
    }
    if (!found.has_solution)
      warn({kind == Mode::Kind::buckling
                ? "no buckling load could be found: nothing compresses the shell, some motion has no stiffness, or the "
                  "iteration did not converge"
                : "no natural frequency could be found: the iteration did not converge"});
  };
  find(Mode::Kind::buckling, problem.modes.buckling, finite::buckling_modes);
  find(Mode::Kind::vibration, problem.modes.vibration, finite::vibration_modes);
}

bool Run::wants_model_check(const problem::Instant& instant) const {
  constexpr double notable = 0.1, growth = 2;  // thicknesses; since the last check
  const double moved = result.summary.max_relative_displacement;
  const double checked = problem.steps_are_cases ? 0 : growth * checked_displacement_;
  return &instant == &instants.back() || moved > std::max(notable, checked);
}

void Run::record(const problem::Instant& instant) {
  judge_certificate(result);
  examine_stability(result, solution());
  latest_.has_jumped = std::exchange(has_jumped_, false);
  if (wants_model_check(instant)) check_model(instant.factors.time);
  recover();
  const assembly::State& state = solution().discrete->state;
  const std::string missed = std::exchange(missed_accuracy, {});
  const bool is_missed = result.status == contact::Status::solved && !missed.empty();
  result.history.push_back({.step = problem.steps[static_cast<std::size_t>(instant.step)].name,
                            .factors = state.factors,
                            .factor_names = problem.factor_names,
                            .controlled_displacement = controlled_displacement(state),
                            .status = is_missed ? contact::Status::accuracy_not_reached : result.status,
                            .missed_limits = is_missed ? missed : result.missed_limits,
                            .level = latest_,
                            .summary = result.summary,
                            .probes = result.probes,
                            .stability = result.stability});
  if (observer.instant) observer.instant(result.history.back(), solution());
  at = &instant;
  if (instant.part == 1) before_step_ = result.probes;
}

void Run::warn(std::vector<std::string> warnings) {
  for (std::string& text : warnings) {
    if (std::ranges::find(result.warnings, text) != result.warnings.end()) continue;
    if (observer.warning) observer.warning(text);
    result.warnings.push_back(std::move(text));
  }
}

void Run::recover() {
  choose_recovery(problem.output, solution());
  result.probes = probe(solution(), problem.probes);
}

Result Run::finish() {
  if (result.solution) {
    const auto& stations = path.stations();
    const auto end = stations.end() - (path.is_broken || stations.size() == 1 ? 0 : 1);
    result.solution->path.assign(stations.begin() + 1, end);
    if (problem.steps.empty()) {
      judge_certificate(result);
      examine_stability(result, solution());
    }
    add_contact_zones(result);
    if (result.history.empty()) recover();
    find_stress_peak(result);
    warn(state_warnings(problem, result));
    find_modes();
    warn(material_warnings(problem, result));
    if (result.status == contact::Status::infeasible) result.missed_limits = contradiction_text(*solution().discrete);
    if (result.status == contact::Status::no_equilibrium)
      result.missed_limits = softest_motion_text(*solution().discrete, solution().nodal);
  }
  adopt_worst_status();
  result.peak_memory = peak_memory(comm);
  return std::move(result);
}

void Run::adopt_worst_status() {
  if (result.status == contact::Status::solved && !missed_accuracy.empty()) {
    result.status = contact::Status::accuracy_not_reached;
    result.missed_limits = missed_accuracy;
  }
  if (result.status == contact::Status::solved && !missed_between.empty()) {
    result.status = contact::Status::inaccurate;
    result.missed_limits = missed_between;
  }
  for (const HistoryEntry& entry : result.history)
    if (result.status == contact::Status::solved && entry.status != contact::Status::solved) {
      result.status = entry.status;
      result.missed_limits = fmt::format("at time {:g}: {}", entry.factors.time, entry.missed_limits);
    }
}

}  // namespace plastron::computation

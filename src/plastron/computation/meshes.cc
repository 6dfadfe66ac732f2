#include <plastron/computation/meshes.hpp>

#include <plastron/computation/adaptivity.hpp>
#include <plastron/computation/approach.hpp>
#include <plastron/computation/evaluation.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/geometry/triangle_mesh.hpp>
#include <plastron/meshing/sequence.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plastron::computation {

namespace {

/// Whether no finer mesh can change this status.
bool is_final(contact::Status status) {
  return status == contact::Status::infeasible || status == contact::Status::singular ||
         status == contact::Status::not_finite;
}

}  // namespace

Meshes::Meshes(Run& run)
    : run_(run),
      sequence_(meshing::mesh_sequence(run.problem, run.comm)),
      surface_(std::make_shared<const fem::Surface>(sequence_.space()->coarse, run.problem.charts)) {}

bool Meshes::solve() {
  const problem::Instant& first = run_.instants.front();
  const int refinements = run_.problem.discretisation.refinements;
  if (run_.problem.accuracy) {
    for (int i = 0; i < refinements; ++i) sequence_.refine({});
    return solve_next(first) && reach_accuracy(first);
  }
  for (int i = 0; i <= refinements; ++i)
    if (!solve_next(first)) return false;
  return true;
}

bool Meshes::reach_accuracy(const problem::Instant& instant) {
  const bool is_first = &instant == &run_.instants.front();
  // Where an obstacle may have passed, finer meshes of a later instant do not help.
  if (!run_.problem.accuracy || are_ahead_ || (run_.path.is_broken && !is_first)) return true;
  Result& result = run_.result;
  const auto is_to_come = [&](const problem::Instant& other) { return other.factors.time > instant.factors.time; };
  const auto to_come = static_cast<int>(std::ranges::count_if(run_.instants, is_to_come));
  AccuracyLoop loop(run_.problem, run_.since_start, to_come, has_lost_stiffness_);
  for (;;) {
    if (loop.wants_witness(result, run_.latest(), space())) confirm(instant);
    const bool wants_more = loop.wants_more(result, run_.latest(), space()) && (is_first || result.estimates);
    run_.end_of_meshes = loop.end_of_meshes();
    run_.latest().goals = loop.goals();
    if (judged_ < result.levels.size()) {
      judged_ = result.levels.size();
      result.levels.back() = run_.latest();
      if (run_.observer.level) run_.observer.level(static_cast<int>(judged_) - 1, result.levels.back());
    }
    if (!wants_more) break;
    cuts_ = loop.cuts();
    marks_ = loop.marks();
    if (solve_next(instant)) continue;
    if (!run_.is_out_of_time()) return false;
    result.status = run_.latest().status;
    are_ahead_ = true;
    loop.give_up(fmt::format("the next mesh was stopped for max_seconds = {:g}", run_.problem.accuracy->max_seconds));
    break;
  }
  run_.end_of_meshes = std::numeric_limits<double>::infinity();
  run_.missed_accuracy = loop.missed();
  has_lost_stiffness_ = loop.has_lost_stiffness();
  return true;
}

void Meshes::begin_again(const problem::Instant& instant, LevelTask task, LevelResult& level) {
  const auto is_controlled = [](const problem::Instant& other) { return other.control != nullptr; };
  if (!run_.problem.accuracy || run_.result.levels.size() < 2 || std::ranges::any_of(run_.instants, is_controlled))
    return;
  fem::MeshSequence start = meshing::mesh_sequence(run_.problem, run_.comm);
  for (int i = 0; i < run_.problem.discretisation.refinements; ++i) start.refine({});
  auto surface = std::make_shared<const fem::Surface>(start.space()->coarse, run_.problem.charts);
  const Path path = std::exchange(run_.path, {});
  task.zone.reset();
  auto again = solved_in_parts(run_, instant, task,
                               assembly::discretise(start.space(), surface, run_.problem.shell, assembly::State{}),
                               pace_of(instant));
  run_.before.reset();
  if (!again) {
    run_.path = path;
    return;
  }
  level = std::move(*again);
  sequence_ = std::move(start);
  surface_ = std::move(surface);
}

bool Meshes::solve_next(const problem::Instant& instant) {
  Result& result = run_.result;
  const int number = static_cast<int>(result.levels.size());
  result.status = contact::Status::interrupted;
  if (wants_to_stop(run_.observer, run_.comm)) return false;
  Stopwatch watch;
  LevelTask task = number == 0 ? run_.task(0) : run_.task_after_first_level(number);
  const bool is_end =
      number == run_.problem.discretisation.refinements && run_.instants.size() == 1 && !instant.control;
  if (run_.problem.accuracy || is_end) task.goals = run_.goals();
  task.judges_buckling = number == run_.problem.discretisation.refinements && instant.part == 1;
  assembly::State start = run_.state_at(instant);
  const bool is_first = &instant == &run_.instants.front();
  const bool is_anew = number == 0 || (is_first && run_.result.passing.value_or(Passing{}).cells > 0);
  if (number > 0) refine(task, start);
  if (is_anew) {
    start = run_.state_at(instant);
    task.zone.reset();
  }
  task.seconds.mesh = watch.lap();
  if (run_.observer.phase) run_.observer.phase(number, "geometry");
  auto discrete = assembly::discretise(sequence_.space(), surface_, run_.problem.shell, std::move(start));
  task.seconds.discretisation = watch.lap();
  LevelResult level = is_anew ? solved_from_start(run_, instant, std::move(task), std::move(discrete))
                              : solve_level(task, std::move(discrete), run_.observer);
  if (level.record.status == contact::Status::interrupted) return false;  // the previous mesh is the result
  if (run_.observer.level && !run_.problem.accuracy) run_.observer.level(number, level.record);
  if (run_.observer.solution) run_.observer.solution(number, level.solution);
  result.levels.push_back(level.record);
  run_.take(std::move(level));
  if (is_fine_enough_to_compare(number)) run_.check_model();
  return !is_final(result.status);
}

bool Meshes::is_fine_enough_to_compare(int number) const {
  // The ratio of the two models hardly changes on finer meshes, where a comparison is expensive.
  constexpr std::int64_t fine = 10'000;  // unknowns
  const problem::Problem& p = run_.problem;
  const bool is_last_but_one = !p.accuracy && number + 1 == p.discretisation.refinements;
  return p.steps.empty() && !run_.result.model && (is_last_but_one || run_.result.levels.back().unknowns > fine);
}

std::vector<algebra::Vector> Meshes::fields_to_transfer() const {
  const Solution& solution = run_.solution();
  std::vector<algebra::Vector> fields{solution.nodal.touching, continued_roots(*solution.discrete, solution.nodal)};
  if (solution.discrete->state.is_deformed()) fields.push_back(solution.nodal.y);
  return fields;
}

void Meshes::refine(LevelTask& task, assembly::State& start) {
  std::vector<algebra::Vector> fields = fields_to_transfer();
  const std::size_t own = fields.size();
  for (std::size_t i = 1; i < run_.path.stations().size(); ++i) fields.push_back(run_.path.stations()[i].displacement);
  start.positions = run_.positions();
  run_.before.reset();  // its fields belong to this mesh
  // One mesh at a time in memory, except where this may be the last one.
  if (!run_.observer.stop) run_.result.solution.reset();
  if (!cuts_.empty()) {
    sequence_.cut(fields, cuts_);
    surface_ = std::make_shared<const fem::Surface>(space().coarse, run_.problem.charts);
  } else if (run_.problem.accuracy) {
    sequence_.refine(fields, marks_);
  } else {
    sequence_.refine(fields);
  }
  task.zone = interpolated_zone(std::move(fields[0]), fields[1]);
  if (own > 2) {
    start.displacement = std::move(fields[2]);
    start.displacement.update_ghosts();
  }
  for (std::size_t i = own; i < fields.size(); ++i) {
    certificate::Station& station = run_.path.stations()[1 + i - own];
    station.displacement = std::move(fields[i]);
    station.displacement.update_ghosts();
  }
}

void Meshes::confirm(const problem::Instant& instant) {
  Stopwatch watch;
  const Solution& solution = run_.solution();
  std::vector<algebra::Vector> fields = fields_to_transfer();
  auto space = sequence_.raised(fields, degrees_of_witness(run_.problem));
  assembly::State start = run_.continued_at(instant);
  if (start.is_deformed()) start.displacement = std::move(fields[2]);
  LevelTask task = run_.task_after_first_level(run_.last_level());
  task.zone = interpolated_zone(std::move(fields[0]), fields[1]);
  task.valued = run_.goals();
  const LevelResult higher = solve_level(
      task, assembly::discretise(std::move(space), surface_, run_.problem.shell, std::move(start)), run_.observer);
  estimation::Estimates& estimates = *run_.result.estimates;
  for (std::size_t g = 0; g < higher.values.size(); ++g) estimates.goals[g].at_higher_degree = higher.values[g];
  if (!higher.values.empty())
    estimates.edge_change = edge_change(solution, higher.solution, run_.result.summary.least_thickness);
  run_.latest().seconds.witness = watch.lap();
}

void Meshes::judge_geometry() {
  constexpr double least_judged = 0.5;  // of the area
  const auto* file = std::get_if<domain::MeshFile>(&run_.problem.domain);
  if (!file || !file->in_space || !run_.result.solution || !run_.result.estimates) return;
  Stopwatch watch;
  const topology::SurfaceComparison second = topology::compared_surface(
      domain::coarse_mesh(run_.problem.domain, surface_->coarse().shape), file->in_space->symmetric);
  // The nodes of remeshed facets lie on the facets and not on the part: a fit through them tells nothing of the part, unless
  // all is plane.
  constexpr double negligible = 1e-6;  // relative to the thickness
  const bool is_plane =
      second.judged_share > least_judged && second.deviation <= negligible * run_.result.summary.least_thickness;
  if (geometry::is_triangle_file(file->path) && !is_plane) {
    run_.result.estimates->geometry =
        estimation::GeometryDeviation{.largest = std::numeric_limits<double>::quiet_NaN()};
    return;
  }
  run_.result.estimates->geometry = {.largest = second.deviation,
                                     .place = {second.place[0], second.place[1], second.place[2]},
                                     .judged_share = second.judged_share};
  if (second.judged_share > least_judged) compare_goals(second);
  run_.result.levels.back().seconds.geometry = watch.lap();
}

void Meshes::compare_goals(const topology::SurfaceComparison& second) {
  auto coarse = std::make_shared<mesh::CoarseMesh>(surface_->coarse());
  coarse->patches = second.patches;
  const auto surface = std::make_shared<const fem::Surface>(std::move(coarse), run_.problem.charts);
  const Solution& solution = run_.solution();
  LevelTask task = run_.task_after_first_level(run_.last_level());
  task.zone = interpolated_zone(solution.nodal.touching, continued_roots(*solution.discrete, solution.nodal));
  task.valued = run_.goals();
  const LevelResult other = solve_level(
      task,
      assembly::discretise(sequence_.space(), surface, run_.problem.shell, run_.continued_at(run_.instants.back())),
      run_.observer);
  auto& goals = run_.result.estimates->goals;
  for (std::size_t g = 0; g < other.values.size(); ++g)
    goals[g].geometry_error = second.decay * std::abs(other.values[g] - goals[g].value);
}

}  // namespace plastron::computation

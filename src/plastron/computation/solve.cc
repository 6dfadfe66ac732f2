// The story, top to bottom:
//   find U in K with a(U, V - U) >= l(V - U) for all V in K              (M17, M18), without obstacle (M11)
// on a sequence of nested meshes. On each: the nodal coordinates make K a box, the active set of the mesh before
// is the first guess, and the finest solution is certified from its strains and bounds. Where there are steps, the finest mesh goes
// through them, each of their parts starting from the one before.
#include <plastron/computation/solve.hpp>

#include <plastron/certificate/moment_point.hpp>
#include <plastron/computation/description.hpp>
#include <plastron/computation/doubts.hpp>
#include <plastron/computation/instants.hpp>
#include <plastron/computation/level.hpp>
#include <plastron/computation/locking.hpp>
#include <plastron/computation/memory.hpp>
#include <plastron/computation/point_supports.hpp>
#include <plastron/computation/probes.hpp>
#include <plastron/computation/stopwatch.hpp>
#include <plastron/computation/stress_peak.hpp>
#include <plastron/computation/zones.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace plastron::computation {

namespace {

bool nothing_to_refine(contact::Status status) {
  return status == contact::Status::infeasible || status == contact::Status::singular ||
         status == contact::Status::not_finite;
}

/// Adds what is new and tells the observer of it.
void warn(std::vector<std::string> warnings, const Observer& observer, Result& result) {
  for (std::string& text : warnings) {
    if (std::ranges::find(result.warnings, text) != result.warnings.end()) continue;
    if (observer.warning) observer.warning(text);
    result.warnings.push_back(std::move(text));
  }
}

/// A computation on its way: meshes one after the other at the first instant, then the other instants on the finest.
class Computation {
 public:
  Computation(const Problem& problem, MPI_Comm comm, const Observer& observer)
      : problem_(problem),
        comm_(comm),
        observer_(observer),
        shell_(shell_description(problem)),
        instants_(instants(problem)),
        meshes_(mesh_sequence(problem, comm)),
        surface_(std::make_shared<const fem::Surface>(meshes_.space()->coarse, problem.charts)) {}

  Result run() {
    result_.has_obstacle = !problem_.obstacles.empty();
    result_.formulation = problem_.discretisation.tangency.formulation;
    result_.warnings = locking_warnings(problem_);
    MPI_Comm_size(comm_, &result_.ranks);
    bool goes_on = true;
    for (int number = 0; goes_on && number <= problem_.discretisation.refinements; ++number) goes_on = mesh(number);
    if (goes_on && !problem_.steps.empty()) note(instants_.front());
    for (std::size_t i = 1; goes_on && i < instants_.size(); ++i) goes_on = advance(instants_[i]);
    if (result_.solution && problem_.steps.empty()) judge_certificate(result_);
    if (result_.solution) {
      warn(contact_warnings(result_, problem_.contact), observer_, result_);
      warn(sideways_warnings(*result_.solution), observer_, result_);
      warn(body_warnings(result_.summary), observer_, result_);
      warn(point_support_warnings(result_, problem_.supports), observer_, result_);
      add_contact_zones(result_);
      if (result_.history.empty()) recover();
      result_.peak = stress_peak(*result_.solution);
    }
    adopt_worst_status();
    result_.peak_memory = peak_memory(comm_);
    return std::move(result_);
  }

 private:
  assembly::State state_at(const Instant& instant) const {
    return {.time = instant.time, .load_factor = instant.load_factor, .force_factors = instant.force_factors};
  }

  /// Where pressed obstacles have come to, to linearise there; at the start if that is to be where gaps are linearised.
  std::vector<double> positions() const {
    return problem_.linearisation.once ? std::vector<double>{} : result_.solution->discrete->positions();
  }

  /// The first instant on the next mesh, whose first guess and state come from the mesh before. Whether the computation goes on.
  bool mesh(int number) {
    result_.status = contact::Status::interrupted;
    if (wants_to_stop(observer_, comm_)) return false;
    Stopwatch watch;
    LevelTask task{.number = number,
                   .settings = problem_.contact,
                   .linearisation = problem_.linearisation,
                   .admissible = problem_.admissible};
    assembly::State start = state_at(instants_.front());
    if (number > 0) refine(task, start);
    task.seconds.mesh = watch.lap();
    if (observer_.phase) observer_.phase(number, "geometry");
    auto discrete = assembly::discretise(meshes_.space(), surface_, shell_, std::move(start));
    task.seconds.discretisation = watch.lap();
    LevelResult level = solve_level(task, std::move(discrete), observer_);
    if (level.record.status == contact::Status::interrupted) return false;  // the mesh before is the result
    if (observer_.level) observer_.level(number, level.record);
    if (observer_.solution) observer_.solution(number, level.solution);
    result_.levels.push_back(level.record);
    take(std::move(level));
    return !nothing_to_refine(result_.status);
  }

  void refine(LevelTask& task, assembly::State& start) {
    std::array fields{result_.solution->nodal.touching, result_.solution->nodal.y};
    const assembly::State& before = result_.solution->discrete->state;
    const bool was_deformed = before.is_deformed();
    start.positions = positions();
    if (!observer_.stop) result_.solution.reset();  // one mesh at a time in memory, unless this may be the last one
    meshes_.refine(std::span(fields).first(was_deformed ? 2 : 1));
    task.touched = std::move(fields[0]);
    if (was_deformed) {
      start.displacement = std::move(fields[1]);
      start.displacement.update_ghosts();
    }
    if (supports_hold(result_.levels.front().history, problem_.contact.solver))
      task.settings.detect_free_motions = false;
  }

  /// The next instant on the finest mesh, from the contact zone and the state of the one before. Whether the computation goes on.
  bool advance(const Instant& instant) {
    if (wants_to_stop(observer_, comm_)) {
      result_.status = contact::Status::interrupted;
      return false;
    }
    Stopwatch watch;
    LevelTask task{.number = problem_.discretisation.refinements,
                   .settings = problem_.contact,
                   .linearisation = problem_.linearisation,
                   .admissible = problem_.admissible,
                   .touched = std::move(result_.solution->nodal.touching)};
    if (supports_hold(result_.levels.front().history, problem_.contact.solver))
      task.settings.detect_free_motions = false;
    assembly::State start = state_at(instant);
    start.positions = positions();
    auto discrete = std::move(result_.solution->discrete);
    if (discrete->state.is_deformed()) start.displacement = std::move(result_.solution->nodal.y);
    result_.solution.reset();
    linearise(*discrete, std::move(start));
    task.seconds.discretisation = watch.lap();
    LevelResult level = solve_level(task, std::move(discrete), observer_);
    if (level.record.status == contact::Status::interrupted) {
      result_.status = level.record.status;
      return false;
    }
    take(std::move(level));
    note(instant);
    return result_.status == contact::Status::solved || result_.status == contact::Status::inaccurate;
  }

  /// A solved end does not hide what missed a limit on the way.
  void adopt_worst_status() {
    for (const HistoryEntry& entry : result_.history)
      if (result_.status == contact::Status::solved && entry.status != contact::Status::solved) {
        result_.status = entry.status;
        result_.missed_limits = fmt::format("at time {:g}: {}", entry.time, entry.missed_limits);
      }
  }

  void take(LevelResult level) {
    result_.status = level.record.status;
    result_.summary = level.verdict.summary;
    take_moments_about(problem_.output.moment_point, result_.summary);
    result_.certificate = level.verdict.certificate;
    latest_ = std::move(level.record);
    result_.solution = std::move(level.solution);
    if (is_beyond_linear_ || result_.status != contact::Status::solved) return;  // what is no solution says nothing
    auto warnings = linear_model_warnings(result_.summary);
    is_beyond_linear_ = !warnings.empty();
    warn(std::move(warnings), observer_, result_);
  }

  /// Resultants of the present solution, and its probes.
  void recover() {
    choose_recovery(problem_.output, *result_.solution);
    result_.probes = probe(*result_.solution, problem_.probes);
  }

  /// The present solution becomes an entry of the history.
  void note(const Instant& instant) {
    judge_certificate(result_);
    recover();
    result_.history.push_back({.step = problem_.steps[static_cast<std::size_t>(instant.step)].name,
                               .time = instant.time,
                               .load_factor = instant.load_factor,
                               .status = result_.status,
                               .missed_limits = result_.missed_limits,
                               .level = latest_,
                               .summary = result_.summary,
                               .probes = result_.probes});
    if (observer_.instant) observer_.instant(result_.history.back(), *result_.solution);
  }

  const Problem& problem_;
  MPI_Comm comm_;
  const Observer& observer_;
  assembly::ShellDescription shell_;
  std::vector<Instant> instants_;
  fem::MeshSequence meshes_;
  std::shared_ptr<const fem::Surface> surface_;
  Result result_{};
  Level latest_{};
  bool is_beyond_linear_ = false;
};

}  // namespace

Result solve(const Problem& problem, MPI_Comm comm, const Observer& observer) {
  return Computation(problem, comm, observer).run();
}

}  // namespace plastron::computation

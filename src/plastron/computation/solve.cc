// The whole computation:
//   find U in K with a(U, V - U) >= l(V - U) for all V in K              (M17, M18), without obstacle (M11)
// on a sequence of nested meshes. On each mesh the nodal coordinates make K a box. The active set of the previous mesh
// is the first guess, and the finest solution is certified from its strains and bounds. With steps, the finest mesh is
// used for all of them, and each part of a step starts from the previous one. If an obstacle could pass through the
// shell between two instants, intermediate instants are solved.
#include <plastron/computation/solve.hpp>

#include <plastron/computation/adaptivity.hpp>
#include <plastron/computation/contact_forecast.hpp>
#include <plastron/computation/doubts.hpp>
#include <plastron/computation/level.hpp>
#include <plastron/computation/locking.hpp>
#include <plastron/computation/memory.hpp>
#include <plastron/computation/passing.hpp>
#include <plastron/computation/point_supports.hpp>
#include <plastron/computation/probes.hpp>
#include <plastron/computation/stopwatch.hpp>
#include <plastron/computation/zones.hpp>
#include <plastron/meshing/sequence.hpp>
#include <plastron/problem/goal_names.hpp>
#include <plastron/problem/instants.hpp>
#include <plastron/solution/summary.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace plastron::computation {

namespace {

bool nothing_to_refine(contact::Status status) {
  return status == contact::Status::infeasible || status == contact::Status::singular ||
         status == contact::Status::not_finite;
}

/// Adds new warnings and passes them to the observer.
void warn(std::vector<std::string> warnings, const Observer& observer, Result& result) {
  for (std::string& text : warnings) {
    if (std::ranges::find(result.warnings, text) != result.warnings.end()) continue;
    if (observer.warning) observer.warning(text);
    result.warnings.push_back(std::move(text));
  }
}

/// An earlier solution.
struct Passed {
  double time;
  ContactTrend trend;
};

/// A running computation: meshes in sequence at the first instant, then the other instants on the finest mesh.
class Computation {
 public:
  Computation(const problem::Problem& problem, MPI_Comm comm, const Observer& observer)
      : problem_(problem),
        comm_(comm),
        asked_(observer),
        observer_(with_time_limit(observer)),
        instants_(problem::instants(problem)),
        meshes_(meshing::mesh_sequence(problem, comm)),
        surface_(std::make_shared<const fem::Surface>(meshes_.space()->coarse, problem.charts)) {}

  Result run() {
    result_.has_obstacle = !problem_.shell.obstacles.empty();
    result_.formulation = problem_.shell.tangency.formulation;
    result_.warnings = locking_warnings(problem_);
    MPI_Comm_size(comm_, &result_.ranks);
    bool goes_on = problem_.accuracy ? meshes_by_accuracy() : uniform_meshes();
    if (goes_on && !problem_.steps.empty()) goes_on = begin();
    for (std::size_t i = 1; goes_on && i < instants_.size(); ++i)
      goes_on = has_time_for(instants_[i]) && approach(instants_[i - 1], instants_[i]) &&
                advance(instants_[i], continued_at(instants_[i]));
    if (result_.solution && problem_.steps.empty()) judge_certificate(result_);
    if (result_.solution) {
      warn(linear_model_warnings(result_), observer_, result_);
      add_contact_zones(result_);
      warn(contact_warnings(result_, problem_.contact), observer_, result_);
      warn(sideways_warnings(result_.summary), observer_, result_);
      warn(body_warnings(result_.summary), observer_, result_);
      warn(point_support_warnings(result_, problem_.shell.supports), observer_, result_);
      if (result_.history.empty()) recover();
      find_stress_peak(result_);
      warn(strain_warnings(result_), observer_, result_);
    }
    adopt_worst_status();
    result_.peak_memory = peak_memory(comm_);
    return std::move(result_);
  }

 private:
  /// Returns the observer with a time limit. With max_seconds the clock may also stop a mesh, once a finished mesh
  /// exists.
  Observer with_time_limit(Observer observer) const {
    if (!problem_.accuracy || std::isinf(problem_.accuracy->max_seconds)) return observer;
    observer.stop = [this, asked = observer.stop] {
      return (asked && asked()) || since_start_.seconds() > end_of_meshes_;
    };
    return observer;
  }

  /// Whether only the clock stopped a mesh, so that the previous one is the result (collective).
  bool is_out_of_time() const {
    return result_.status == contact::Status::interrupted && !std::isinf(end_of_meshes_) && result_.solution &&
           !wants_to_stop(asked_, comm_);
  }

  /// Whether there is time for an instant. A running instant is not stopped, because the previous solution no longer
  /// exists (collective).
  bool has_time_for(const problem::Instant& instant) {
    if (!problem_.accuracy) return true;
    const double max_seconds = problem_.accuracy->max_seconds;
    if (algebra::max_over_ranks(since_start_.seconds(), comm_) <= max_seconds) return true;
    missed_accuracy_ +=
        fmt::format("{}max_seconds = {:g} was over before time {:g}, and the result is that of time {:g}",
                    missed_accuracy_.empty() ? "" : "; ", max_seconds, instant.time, at_->time);
    return false;
  }

  assembly::State state_at(const problem::Instant& instant) const {
    return {.time = instant.time, .load_factor = instant.load_factor, .force_factors = instant.force_factors};
  }

  /// Solves uniform meshes; each divides all cells of the previous one. Returns whether the computation continues, in
  /// this and all following functions.
  bool uniform_meshes() {
    bool goes_on = true;
    for (int number = 0; goes_on && number <= problem_.discretisation.refinements; ++number) goes_on = mesh(number);
    return goes_on;
  }

  /// Solves as many meshes as the goals need at the first instant, and then at the last one. Returns whether the
  /// computation continues.
  bool meshes_by_accuracy() {
    for (int i = 0; i < problem_.discretisation.refinements; ++i) meshes_.refine({});
    if (!meshes_for_goals()) return false;
    if (instants_.size() == 1 || meshes_are_ahead_) return true;
    if (!approach_last()) return false;
    on_mesh_ = &instants_.back();
    cuts_.clear();
    marks_.assign(meshes_.space()->owned_cells, 0);
    end_of_meshes_ = problem_.accuracy->max_seconds;  // the solution at the first instant can be the result
    return meshes_for_goals() || result_.status != contact::Status::interrupted;  // it may be unreachable at once
  }

  /// Solves meshes at one instant, from the present mesh on.
  bool meshes_for_goals() {
    const bool is_first = on_mesh_ == &instants_.front();
    const int instants_to_come = problem_.steps.empty() ? 0 : static_cast<int>(instants_.size());
    AccuracyLoop loop(problem_, since_start_, instants_to_come);
    for (bool wants_more = true; wants_more;) {
      const int number = static_cast<int>(result_.levels.size());
      if (!mesh(number)) {
        if (!is_out_of_time()) return false;
        result_.status = result_.levels.back().status;
        meshes_are_ahead_ = true;
        loop.give_up(fmt::format("the next mesh was stopped for max_seconds = {:g}", problem_.accuracy->max_seconds));
        break;
      }
      if (loop.wants_witness(result_, *meshes_.space())) call_witness(*on_mesh_);
      wants_more = loop.wants_more(result_, *meshes_.space()) && (is_first || result_.estimates);
      end_of_meshes_ = loop.end_of_meshes();
      result_.levels.back().goals = loop.goals();
      if (observer_.level) observer_.level(number, result_.levels.back());
      cuts_ = loop.cuts();
      marks_ = loop.marks();
      if (is_first) continue;
      // Cells that the first instant needs stay.
      for (signed char& mark : marks_) mark = std::max<signed char>(mark, 0);
    }
    end_of_meshes_ = std::numeric_limits<double>::infinity();
    missed_accuracy_ = loop.missed();
    return true;
  }

  /// Takes the first instant on the finest mesh, or solves it again if another one was solved there. Returns whether
  /// the computation continues.
  bool begin() {
    const problem::Instant& first = instants_.front();
    if (on_mesh_ != &first) {
      auto discrete = std::move(result_.solution->discrete);
      if (!start_out(discrete, first)) return false;
      if (!discrete) return advance(first, continued_at(first));
      result_.solution->discrete = std::move(discrete);
      return advance(first, state_at(first));
    }
    note(first);
    return true;
  }

  /// Returns the quantities whose errors are estimated: the goals where an accuracy is requested, else energy and
  /// reaction.
  std::vector<estimation::Goal> goals() const {
    if (problem_.accuracy) return problem::estimated_goals(problem_);
    std::vector<estimation::Goal> goals{{"energy", estimation::Energy{}}};
    if (!problem_.shell.obstacles.empty()) goals.push_back({"reaction", estimation::ObstacleForce{}});
    return goals;
  }

  /// Returns the positions of pressed obstacles, for the linearisation there. Empty if gaps are linearised at the
  /// start.
  std::vector<double> positions() const {
    return problem_.shell.obstacles.are_linear ? std::vector<double>{} : result_.solution->discrete->positions();
  }

  /// Solves an instant, by default the first, on the next mesh. First guess and state come from the previous mesh.
  /// Returns whether the computation continues.
  bool mesh(int number) {
    result_.status = contact::Status::interrupted;
    if (wants_to_stop(observer_, comm_)) return false;
    Stopwatch watch;
    LevelTask task{.number = number,
                   .settings = problem_.contact,
                   .linearisation = problem_.linearisation,
                   .admissible = problem_.admissible};
    const bool is_end = number == problem_.discretisation.refinements && instants_.size() == 1;
    if (problem_.accuracy || is_end) task.goals = goals();
    assembly::State start = state_at(*on_mesh_);
    if (number > 0) refine(task, start);
    task.seconds.mesh = watch.lap();
    if (observer_.phase) observer_.phase(number, "geometry");
    auto discrete = assembly::discretise(meshes_.space(), surface_, problem_.shell, std::move(start));
    if (number == 0 && !start_out(discrete, *on_mesh_)) {
      if (result_.levels.empty()) result_.solution.reset();
      return false;
    }
    if (!discrete) discrete = shell_at(*on_mesh_, task);
    task.seconds.discretisation = watch.lap();
    LevelResult level = solve_level(task, std::move(discrete), observer_);
    if (level.record.status == contact::Status::interrupted) return false;  // the previous mesh is the result
    if (observer_.level && !problem_.accuracy) observer_.level(number, level.record);
    if (observer_.solution) observer_.solution(number, level.solution);
    result_.levels.push_back(level.record);
    take(std::move(level));
    return !nothing_to_refine(result_.status);
  }

  void refine(LevelTask& task, assembly::State& start) {
    const solution::NodalSolution& nodal = result_.solution->nodal;
    std::array fields{nodal.touching, continued_roots(*result_.solution->discrete, nodal), nodal.y};
    const assembly::State& before = result_.solution->discrete->state;
    const bool was_deformed = before.is_deformed();
    start.positions = positions();
    // One mesh at a time in memory, except where this may be the last one.
    if (!observer_.stop) result_.solution.reset();
    const auto carried = std::span(fields).first(was_deformed ? 3 : 2);
    if (!cuts_.empty()) {
      meshes_.cut(carried, cuts_);
      surface_ = std::make_shared<const fem::Surface>(meshes_.space()->coarse, problem_.charts);
    } else if (problem_.accuracy) {
      meshes_.refine(carried, marks_);
    } else {
      meshes_.refine(carried);
    }
    task.zone = interpolated_zone(std::move(fields[0]), fields[1]);
    if (was_deformed) {
      start.displacement = std::move(fields[2]);
      start.displacement.update_ghosts();
    }
    if (supports_hold(result_.levels.front().history, problem_.contact.solver))
      task.settings.detect_free_motions = false;
  }

  /// Computes the goals at one degree more on the cells of the present solution, if that problem can be solved.
  void call_witness(const problem::Instant& instant) {
    Stopwatch watch;
    const solution::NodalSolution& nodal = result_.solution->nodal;
    std::array fields{nodal.touching, continued_roots(*result_.solution->discrete, nodal), nodal.y};
    auto space = meshes_.raised(fields, degrees_of_witness(problem_));
    assembly::State start = continued_at(instant);
    if (start.is_deformed()) start.displacement = std::move(fields[2]);
    LevelTask task{.number = std::max(0, static_cast<int>(result_.levels.size()) - 1),
                   .settings = problem_.contact,
                   .linearisation = problem_.linearisation,
                   .admissible = problem_.admissible,
                   .zone = interpolated_zone(std::move(fields[0]), fields[1]),
                   .valued = goals()};
    if (supports_hold(result_.levels.front().history, problem_.contact.solver))
      task.settings.detect_free_motions = false;
    const LevelResult witness = solve_level(
        task, assembly::discretise(std::move(space), surface_, problem_.shell, std::move(start)), observer_);
    for (std::size_t g = 0; g < witness.values.size(); ++g)
      result_.estimates->goals[g].at_higher_degree = witness.values[g];
    if (!witness.values.empty())
      result_.estimates->edge_change =
          edge_change(*result_.solution, witness.solution, result_.summary.least_thickness);
    result_.levels.back().seconds.witness = watch.lap();
  }

  /// Returns the state of an instant that starts from the present solution.
  assembly::State continued_at(const problem::Instant& instant) const {
    assembly::State start = state_at(instant);
    start.positions = positions();
    if (result_.solution->discrete->state.is_deformed()) start.displacement = result_.solution->nodal.y;
    return start;
  }

  /// Returns the shell of the present solution, linearised for an instant that starts from that solution.
  std::unique_ptr<assembly::DiscreteShell> shell_at(const problem::Instant& instant, LevelTask& task) {
    const ContactTrend trend = contact_trend(*result_.solution->discrete, result_.solution->nodal);
    assembly::State start = continued_at(instant);
    auto discrete = std::move(result_.solution->discrete);
    result_.solution.reset();
    linearise(*discrete, std::move(start));
    task.zone = expected_zone(*discrete, trend);
    return discrete;
  }

  /// Returns the next part of the way between two instants, after `done`. It is so short that obstacles cannot pass
  /// through the shell at `y`.
  static double next_part(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                          const problem::Instant& from, const problem::Instant& to, double done) {
    constexpr double least = 0x1p-10;
    const auto time = [&](double part) { return problem::between(from, to, part).time; };
    double next = 1;
    while (next - done > least && may_pass(discrete, y, time(done), time(next))) next = done + (next - done) / 2;
    return next;
  }

  /// Solves an intermediate instant whose results are not requested. Returns whether the computation continues.
  bool pass(const problem::Instant& instant, std::unique_ptr<assembly::DiscreteShell> discrete, LevelTask task) {
    task.number = std::max(0, static_cast<int>(result_.levels.size()) - 1);
    task.settings = problem_.contact;
    task.linearisation = problem_.linearisation;
    task.admissible = problem_.admissible;
    LevelResult level = solve_level(task, std::move(discrete), observer_);
    result_.status = level.record.status;
    if (result_.status == contact::Status::interrupted) return false;
    if (result_.levels.empty() && result_.status != contact::Status::solved) result_.levels.push_back(level.record);
    take(std::move(level));
    passed_.reset();
    judge_certificate(result_);
    if (result_.status == contact::Status::solved) return true;
    if (missed_on_the_way_.empty())
      missed_on_the_way_ =
          fmt::format("at time {:g}, on the way of the moving obstacles: {}", instant.time, status_text(result_));
    warn({missed_on_the_way_}, observer_, result_);
    return result_.status == contact::Status::inaccurate;
  }

  /// Solves intermediate instants from the present solution, after the part `done`. Their number prevents that
  /// obstacles pass through the shell. Returns whether the computation continues.
  bool approach(const problem::Instant& from, const problem::Instant& to, double done = 0) {
    for (;;) {
      const Solution& at_hand = *result_.solution;
      done = next_part(*at_hand.discrete, at_hand.nodal.y, from, to, done);
      if (done == 1) return true;
      if (wants_to_stop(observer_, comm_)) {
        result_.status = contact::Status::interrupted;
        return false;
      }
      const problem::Instant instant = problem::between(from, to, done);
      LevelTask task;
      auto discrete = shell_at(instant, task);
      if (!pass(instant, std::move(discrete), std::move(task))) return false;
    }
  }

  /// The same, starting from the undeformed shell. `discrete` stays if no instant is needed; otherwise it becomes the
  /// shell of the present solution.
  bool start_out(std::unique_ptr<assembly::DiscreteShell>& discrete, const problem::Instant& to) {
    if (problem_.steps.empty()) return true;
    const problem::Instant start{.load_factor = 0,
                                 .force_factors = std::vector<double>(problem_.shell.obstacles.all.size(), 0)};
    const algebra::Vector undeformed(discrete->space().layout, 6);
    const double first = next_part(*discrete, undeformed, start, to, 0);
    if (first == 1) return true;
    const problem::Instant instant = problem::between(start, to, first);
    linearise(*discrete, state_at(instant));
    return pass(instant, std::move(discrete), {}) && approach(start, to, first);
  }

  /// Goes from the first instant to the last one without their results, if an obstacle could pass through the shell in
  /// one step.
  bool approach_last() {
    const Solution& at_hand = *result_.solution;
    if (!may_pass(*at_hand.discrete, at_hand.nodal.y, instants_.front().time, instants_.back().time)) return true;
    for (std::size_t i = 1; i < instants_.size(); ++i) {
      if (!approach(instants_[i - 1], instants_[i])) return false;
      if (i + 1 == instants_.size()) break;
      LevelTask task;
      auto discrete = shell_at(instants_[i], task);
      if (!pass(instants_[i], std::move(discrete), std::move(task))) return false;
    }
    return true;
  }

  /// Solves an instant on the finest mesh, from a state and the contact zone of the present solution. Returns whether
  /// the computation continues.
  bool advance(const problem::Instant& instant, assembly::State start) {
    if (wants_to_stop(observer_, comm_)) {
      result_.status = contact::Status::interrupted;
      return false;
    }
    Stopwatch watch;
    LevelTask task{.number = problem_.discretisation.refinements,
                   .settings = problem_.contact,
                   .linearisation = problem_.linearisation,
                   .admissible = problem_.admissible};
    if (&instant == &instants_.back()) task.goals = goals();
    if (supports_hold(result_.levels.front().history, problem_.contact.solver))
      task.settings.detect_free_motions = false;
    const ContactTrend expected = expected_at(instant);
    auto discrete = std::move(result_.solution->discrete);
    result_.solution.reset();
    linearise(*discrete, std::move(start));
    task.zone = expected_zone(*discrete, expected);
    task.seconds.discretisation = watch.lap();
    LevelResult level = solve_level(task, std::move(discrete), observer_);
    if (level.record.status == contact::Status::interrupted) {
      result_.status = level.record.status;
      return false;
    }
    take(std::move(level));
    if (problem_.accuracy && result_.estimates) judge_accuracy_at_end(instant);
    note(instant);
    return result_.status == contact::Status::solved || result_.status == contact::Status::inaccurate;
  }

  /// Returns the expected contact from the present solution. Within a step the trend of contact is expected to
  /// continue.
  ContactTrend expected_at(const problem::Instant& instant) {
    ContactTrend now = contact_trend(*result_.solution->discrete, result_.solution->nodal);
    const std::optional<Passed> before = std::exchange(passed_, {});
    if (!at_) return now;
    passed_ = Passed{at_->time, now};
    if (!before || at_->step != instant.step || before->time < at_->step) return now;
    return continued(std::move(now), before->trend, (instant.time - at_->time) / (at_->time - before->time));
  }

  /// Judges the accuracy at the last instant. The steps may lead to another solution than the one for which the mesh
  /// was made.
  void judge_accuracy_at_end(const problem::Instant& instant) {
    const estimation::Estimates& estimates = *result_.estimates;
    if (!meshes_are_ahead_ && wants_witness(problem_, *meshes_.space(), estimates, result_.summary))
      call_witness(instant);
    const std::string missed = estimation::shortfall(
        estimation::goal_records(problem::estimated_goals(problem_), estimates, result_.summary), estimates);
    if (missed.empty()) return;
    missed_accuracy_ +=
        fmt::format("{}at the last instant, reached step by step, {}", missed_accuracy_.empty() ? "" : "; ", missed);
  }

  /// Sets the worst status, so that a solved end does not hide a missed limit of an earlier instant.
  void adopt_worst_status() {
    if (result_.status == contact::Status::solved && !missed_accuracy_.empty()) {
      result_.status = contact::Status::accuracy_not_reached;
      result_.missed_limits = missed_accuracy_;
    }
    if (result_.status == contact::Status::solved && !missed_on_the_way_.empty()) {
      result_.status = contact::Status::inaccurate;
      result_.missed_limits = missed_on_the_way_;
    }
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
    result_.estimates = std::move(level.estimates);
  }

  /// Computes resultants of the present solution, and its probes.
  void recover() {
    choose_recovery(problem_.output, *result_.solution);
    result_.probes = probe(*result_.solution, problem_.probes);
  }

  /// Adds the present solution to the history.
  void note(const problem::Instant& instant) {
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
    at_ = &instant;
  }

  const problem::Problem& problem_;
  MPI_Comm comm_;
  const Observer& asked_;
  Stopwatch since_start_{};
  double end_of_meshes_ =
      std::numeric_limits<double>::infinity();  ///< [s since the start]; none before the first mesh is finished
  Observer observer_;                           ///< the caller's observer with the time limit
  std::vector<problem::Instant> instants_;
  fem::MeshSequence meshes_;
  bool meshes_are_ahead_ = false;  ///< whether the clock stopped a mesh after the one of the solution
  std::shared_ptr<const fem::Surface> surface_;
  Result result_{};
  Level latest_{};
  const problem::Instant* on_mesh_ = &instants_.front();  ///< instant that is solved on each mesh
  const problem::Instant* at_ = nullptr;                  ///< instant of the latest entry of the history
  std::optional<Passed> passed_{};                        ///< trend at the instant before that one
  std::vector<fem::Cuts> cuts_{};                         ///< cuts for the next mesh, where an accuracy is requested
  std::vector<signed char> marks_{};                      ///< marks of cells for the next mesh, where there are no cuts
  std::string missed_accuracy_{};
  std::string missed_on_the_way_{};  ///< limits missed between instants
};

}  // namespace

Result solve(const problem::Problem& problem, MPI_Comm comm, const Observer& observer) {
  return Computation(problem, comm, observer).run();
}

}  // namespace plastron::computation

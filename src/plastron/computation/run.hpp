// The state of a running computation: its problem, its clock, the latest solution, and the result so far.
#pragma once
#include <plastron/computation/contact_forecast.hpp>
#include <plastron/computation/level.hpp>
#include <plastron/computation/path.hpp>
#include <plastron/computation/resources.hpp>
#include <plastron/problem/instants.hpp>
#include <plastron/problem/problem.hpp>

#include <mpi.h>

#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plastron::computation {

/// Contact at an instant, from which the contact of later ones is extrapolated.
struct PreviousInstant {
  double time;
  ContactTrend trend;
};

/// A solution as a start of others: it outlives their attempts.
struct Departure {
  assembly::State state{};
  ContactTrend trend{};
};

/// A computation from its start to its result. Functions that return bool return whether the computation continues; if
/// it does not, result.status says why.
class Run {
 public:
  Run(const problem::Problem& problem, MPI_Comm comm, const Observer& observer);
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  const problem::Problem& problem;
  const MPI_Comm comm;
  const Stopwatch since_start{};
  Observer observer;  ///< the caller's observer; with max_seconds, the clock also stops a mesh once a mesh is finished
  /// Time at which the clock stops a mesh [s since the start]; infinite before the first mesh is finished.
  double end_of_meshes = std::numeric_limits<double>::infinity();
  const std::vector<problem::Instant> instants;
  const problem::Instant* at = nullptr;  ///< instant of the latest entry of the history
  /// The instant before that one, if no intermediate instant was solved since.
  std::optional<PreviousInstant> before{};
  Path path{};  ///< from the undeformed shell to the solution at hand
  Result result{};
  std::string missed_accuracy{};  ///< text on goals that the solution at hand does not meet; with steps, of its instant
  std::string missed_between{};   ///< text on limits that intermediate instants miss

  /// The solution at hand. Precondition: there is one.
  Solution& solution() { return *result.solution; }
  const Solution& solution() const { return *result.solution; }

  /// Whether the caller requests the end. The status is then interrupted (collective).
  bool is_interrupted();
  /// Whether only the clock stopped a mesh, so that the previous one is the result (collective).
  bool is_out_of_time() const;
  /// Whether max_seconds is over (collective).
  bool is_time_over() const;
  /// Whether max_seconds leaves time for an instant. A running instant is not stopped, because the previous solution no
  /// longer exists (collective).
  bool has_time_for(const problem::Instant& instant);

  /// Quantities whose errors are estimated: the goals where an accuracy is requested, else energy and reaction.
  std::vector<estimation::Goal> goals() const;
  /// The settings of a contact problem on a level.
  LevelTask task(int number) const;
  /// The same, without the search for free motions if the first level showed that the supports alone fix the shell.
  LevelTask task_after_first_level(int number) const;
  int last_level() const { return std::max(0, static_cast<int>(result.levels.size()) - 1); }

  assembly::State state_at(const problem::Instant& instant) const;
  /// The state of an instant that starts from the solution at hand.
  assembly::State continued_at(const problem::Instant& instant) const;
  /// The solution at hand as a start, with the contact that is expected at an instant.
  Departure departure(const problem::Instant& instant, ContactTrend expected) const {
    return {continued_at(instant), std::move(expected)};
  }
  /// The state of an instant that starts from there.
  assembly::State state_at(const problem::Instant& instant, const Departure& departure) const;
  /// Returns an instant between others, which is kept to the end.
  const problem::Instant& keep(problem::Instant instant) { return chosen_.emplace_back(std::move(instant)); }
  /// Returns the contact of the solution at hand, or the contact expected at a later instant: within a step the trend of contact
  /// is expected to continue.
  ContactTrend expected_contact(const problem::Instant* later = nullptr);
  /// Makes the undeformed shell the solution at hand, with obstacles outside of it (collective).
  void rest_at(const problem::Instant& start, std::unique_ptr<assembly::DiscreteShell> discrete);
  /// Positions of pressed obstacles for the linearisation there; empty if gaps are linearised at the start.
  std::vector<double> positions() const;
  /// The shell of the solution at hand, linearised at another state; `task` gets the contact zone expected there. There
  /// is no solution afterwards.
  std::unique_ptr<assembly::DiscreteShell> relinearised(assembly::State state, const ContactTrend& expected,
                                                        LevelTask& task);

  /// Searches for obstacles that may pass through the shell between the solution at hand and a level (collective).
  void search_path(LevelResult& level);
  /// Takes a level as the solution at hand.
  void take(LevelResult level);
  /// How the solution at hand was computed.
  Level& latest() { return latest_; }
  /// Compares the solution at hand with the model of finite rotations, unless the case leaves that out (collective).
  void check_model(double time = 0);
  /// Whether the comparison was made on a coarser mesh; its numbers are then carried to this one.
  bool has_checked_model();
  /// Adds the solution at hand to the history.
  void record(const problem::Instant& instant);
  /// Adds new warnings to the result and passes them to the observer.
  void warn(std::vector<std::string> warnings);
  /// Evaluates the last solution, and returns the result.
  Result finish();

 private:
  void recover();
  /// Computes the modes about the last solution (collective).
  void find_modes();
  /// Says why modes are not looked for any longer: the caller requests the end, or the time is over (collective).
  void give_up_modes(Mode::Kind kind);
  /// Whether the solution at an instant is compared: the last one, and others that have moved much farther.
  bool wants_model_check(const problem::Instant& instant) const;
  /// Sets the worst status, so that a solved end does not hide a missed limit of an earlier instant.
  void adopt_worst_status();

  const Observer& asked_;
  std::deque<problem::Instant> chosen_{};
  algebra::Vector depths_{};  ///< gaps of the undeformed shell below 0; without layout where there are none [m]
  Level latest_{};
  bool has_jumped_ = false;                ///< since the last entry of the history, or since the start
  std::vector<ProbeValue> before_step_{};  ///< at the end of the last completed step
  double checked_displacement_ = 0;        ///< largest |u| / e of the last solution that was compared
};

}  // namespace plastron::computation

// The result of a computation: status, summary, certificate, data of its levels and steps, and the last solution.
#pragma once
#include <plastron/certificate/certificate_limits.hpp>
#include <plastron/certificate/crossings.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/estimation/goal_record.hpp>
#include <plastron/finite/modes.hpp>
#include <plastron/recovery/layer_stresses.hpp>
#include <plastron/recovery/stress_peak.hpp>

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::computation {

/// Wall time of the phases of one level [s].
struct Seconds {
  double mesh = 0;            ///< refinement, numbering, transfer
  double discretisation = 0;  ///< geometry, bounds, loads
  double assembly = 0;        ///< stiffness matrix and its pattern
  double analysis = 0;        ///< symbolic factorisation
  double factorisation = 0;   ///< numeric factorisations, all of them
  double iteration = 0;       ///< the rest of the active-set iteration: residuals, triangular solves
  double certificate = 0;
  double estimates = 0;  ///< estimates of errors, on the finest mesh
  double witness = 0;    ///< the whole solution at one degree more
  double geometry = 0;   ///< the whole solution on a second surface, for meshes in space
  double total() const {
    return mesh + discretisation + assembly + analysis + factorisation + iteration + certificate + estimates + witness +
           geometry;
  }
};

/// One mesh of the sequence.
struct Level {
  std::int64_t cells = 0, nodes = 0, unknowns = 0;
  double time = 0;  ///< of the instant that was solved on it, where there are steps
  contact::Status status = contact::Status::solved;
  std::int64_t active = 0;  ///< nodes in contact
  int iterations = 0;       ///< active-set iterations
  int factorisations = 0;
  int linearisations = 1;            ///< number of linearisations of the gaps
  double gap_error = 0;              ///< largest |distance - linearised gap| of the deformed faces in contact [m]
  double energy = 0;                 ///< 1/2 a(U, U) [J]
  int lift_rounds = 0;               ///< number of times that bounds of gaps were lifted
  double energy_before_lifts = 0;    ///< energy of the solution with bounds at 0; `energy` where none was lifted [J]
  double reaction = 0;               ///< norm of the obstacle's resultant force [N]
  double contact_area = 0;           ///< [m^2]
  double max_normal_rotation = 0;    ///< max |r . a_3|
  double multiplier_norm = 0;        ///< norm of lambda [N m]
  double min_gap = 0;                ///< at nodes [m]
  double linear_residual = 0;        ///< relative residual of the last linear solve
  contact::Tolerances tolerances{};  ///< tolerances of bounds and signs
  double max_rotation = 0;           ///< max |r| [rad]
  /// With finite rotations: a motion had no stiffness on the way, and the shell moved far beyond the linear prediction.
  bool has_jumped = false;
  /// With finite rotations: a motion had no stiffness on the way.
  bool has_lost_stiffness = false;
  bool is_control_blind = false;  ///< the loads do not move the displacement that is to control them
  /// Membrane forces over those under which a perfect shell buckles (estimation::buckling()), where it was computed.
  std::optional<double> buckling{};
  std::vector<estimation::GoalRecord> goals{};  ///< empty if no accuracy is requested
  std::vector<contact::Iteration> history{};
  Seconds seconds{};
};

/// Displacements, resultants, reaction at a named point.
struct ProbeValue {
  std::string name;
  recovery::PointValues values;
};

/// A motion about the last solution, with contact held (finite/modes.hpp).
struct Mode {
  enum class Kind { buckling, vibration, softest };
  Kind kind = Kind::buckling;
  int number = 1;
  /// Factor of loads and contact forces at which the shell buckles, the square of the angular frequency [1/s^2], or the margin of
  /// stability with finite rotations.
  double value = 0;
  algebra::Vector shape{};  ///< (u, r); the largest |u| is 1

  /// Returns the frequency [Hz]; NaN for a motion that grows.
  double frequency() const;
  /// Returns "buckling_1", "vibration_2" and so on, or "softest_motion".
  std::string name() const;
};

/// The finest solution, kept for output and further work.
struct Solution {
  std::unique_ptr<assembly::DiscreteShell> discrete;
  solution::NodalSolution nodal;
  contact::BoxSolution box{};   ///< the solution in coordinates, with small rotations
  recovery::Choice recovery{};  ///< choice of the fields; see choose_recovery()
  /// Estimated squared error in the energy norm of each owned cell [J]; empty if not requested.
  std::vector<double> cell_errors{};
  std::vector<Mode> modes{};                    ///< modes that the case asks for, with shapes
  std::vector<certificate::CellGap> entered{};  ///< this rank's cells with a gap below 0 in some place
  std::vector<std::size_t> crossed{};           ///< this rank's cells through which an obstacle may have passed
  /// States of the path from the start to this one that the proof needs, without both ends.
  std::vector<certificate::Station> path{};
};

/// Obstacles that may have passed through the shell on its path.
struct Passing {
  std::int64_t cells = 0;  ///< number of cells
  std::string place{};     ///< an obstacle and a place in words
};

/// The solution at the end of a step, or of a part of one.
struct HistoryEntry {
  std::string step;  ///< name of the step
  energy::Factors factors = energy::Factors();
  std::vector<std::string> factor_names{};          ///< of factors.named
  std::optional<double> controlled_displacement{};  ///< that the loads follow [m]
  contact::Status status = contact::Status::solved;
  std::string missed_limits{};
  Level level;  ///< how it was computed
  solution::Summary summary;
  std::vector<ProbeValue> probes{};
  std::optional<finite::Stability> stability{};  ///< with finite rotations
};

/// Returns the displacement that controls the loads of a state.
inline std::optional<double> controlled_displacement(const assembly::State& state) {
  return state.control ? std::optional(state.control->displacement) : std::nullopt;
}

/// A number of the linear solution beside the same number of the model with finite rotations.
struct ModelQuantity {
  std::string name{}, unit{};
  double linear = 0, finite = 0;
  double least = 0;       ///< numbers below this are rounding, or too small to matter
  bool is_judged = true;  ///< whether it counts for ModelCheck::largest()
  /// Error of the linear model, relative to the other.
  double difference() const {
    const double absolute = std::abs(linear - finite), scale = std::max(std::abs(finite), least);
    return absolute == 0 ? 0 : absolute / scale;
  }
};

/// Comparison of the linear solution with the model of finite rotations (model_check.hpp).
struct ModelCheck {
  contact::Status status = contact::Status::solved;  ///< status of the step; without quantities if it is not solved
  /// Whether every motion has a positive stiffness. If not, the shell buckles or snaps through near this solution.
  bool is_stable = true;
  double time = 0;                   ///< time of the solution, if there are steps
  double relative_displacement = 0;  ///< largest |u| / e of the linear solution
  double rotation = 0;               ///< largest |r| of the linear solution [rad]
  int steps = 0;                     ///< number of Newton steps
  int factorisations = 0;
  double seconds = 0;
  std::vector<ModelQuantity> quantities{};

  double largest() const {
    double most = 0;
    for (const ModelQuantity& quantity : quantities)
      if (quantity.is_judged && quantity.difference() > most) most = quantity.difference();
    return most;
  }
};

/// Returns "solved", "unstable", "no_solution", or "unknown" where the contact problem of a step was not solved.
std::string word_of(const ModelCheck& check);

struct Result {
  contact::Status status = contact::Status::solved;
  /// Text on limits of the certificate or the accuracy that are missed; empty if all are met.
  std::string missed_limits{};
  solution::Summary summary{};
  certificate::Certificate certificate{};
  std::optional<Passing> passing{};                        ///< empty if no obstacle has a far side
  std::vector<certificate::CertificateLimit> limits{};     ///< limits of the certificate's rows
  std::vector<ProbeValue> probes{};                        ///< equal on every rank
  recovery::StressPeak peak{};                             ///< peak of the last solution
  std::vector<recovery::SingularPlace> singular_places{};  ///< places that the peak ignores
  std::vector<recovery::LayerStress> layers{};             ///< stresses by layer; empty without laminates
  /// All meshes, in order. With steps: those of the first instant, and with an accuracy also those of later ones.
  std::vector<Level> levels{};
  /// By instant; empty without steps. Each is solved on the last mesh so far.
  std::vector<HistoryEntry> history{};
  bool has_obstacle = false;
  element::Formulation formulation = element::Formulation::tangent;
  element::Rotations rotations = element::Rotations::small;
  int ranks = 1;
  std::vector<std::string> warnings{};  ///< texts for the user
  double peak_memory = 0;               ///< memory of all ranks together [bytes]
  std::optional<Solution> solution{};   ///< empty when nothing could be solved
  /// Estimates of the last solution's errors; empty if there is no solution or if not requested.
  std::optional<estimation::Estimates> estimates{};
  std::vector<Mode> modes{};                     ///< those of the solution, without shapes
  std::optional<finite::Stability> stability{};  ///< of the last solution with finite rotations
  std::optional<ModelCheck> model{};             ///< the worst of all that were made; empty if there is none

  /// Data of the last solution: on the last mesh, at the last instant.
  const Level& last_level() const { return history.empty() ? levels.back() : history.back().level; }
  /// Largest eta at nodes where it is a density, without nodes of lines that touch; NaN if there are only lines [Pa].
  double max_pressure() const;
};

/// Receives progress; every member may be empty. Called on every rank.
struct Observer {
  std::function<void(int level, std::string_view phase)> phase{};
  std::function<void(int level, const contact::Iteration&)> iteration{};
  std::function<void(int level, const Level&)> level{};
  std::function<void(std::string_view text)> warning{};  ///< called as soon as it is known; the result has it too
  /// Solution of every level, which does not exist afterwards.
  std::function<void(int level, const Solution&)> solution{};
  std::function<void(const HistoryEntry&, const Solution&)> instant{};  ///< every instant, where there are steps
  /// Called between active-set iterations and between meshes: true ends the computation with status interrupted. It
  /// must be empty on all ranks or on none. If one rank returns true, all stop.
  std::function<bool()> stop{};
};

/// Whether any rank wants to stop (collective).
inline bool wants_to_stop(const Observer& observer, MPI_Comm comm) {
  return observer.stop && algebra::sum_over_ranks(std::int64_t{observer.stop()}, comm) > 0;
}

/// Returns a text on the end of the computation, in a sentence or two.
std::string status_text(const Result& result);

}  // namespace plastron::computation

// What a computation returns: status, summary, certificate, the story of its levels and steps, and the last solution itself.
#pragma once
#include <plastron/certificate/certificate_limits.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/estimation/estimates.hpp>
#include <plastron/recovery/stress_peak.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
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
  double estimates = 0;  ///< of errors, on the finest mesh
  double witness = 0;    ///< the solution at one degree more, all of it
  double total() const {
    return mesh + discretisation + assembly + analysis + factorisation + iteration + certificate + estimates + witness;
  }
};

/// A number that is asked for, as one mesh has it.
struct GoalRecord {
  std::string name{};
  double value = 0;
  double difference = 0;  ///< signed: of the exact value minus `value`, as far as the sign can be known
  double error = 0;       ///< how large |exact value - value| is thought to be
  double tolerance = 0;   ///< of the error, over `scale`
  double scale = 0;       ///< |value|, or what numbers of its kind amount to if that is more
  double dual_energy = 0;
  bool has_estimate = true;

  double relative_estimate() const { return scale > 0 ? error / scale : 0; }
  /// Of an absolute error. A value of zero allows none.
  double allowed() const { return std::max(tolerance * scale, std::numeric_limits<double>::min()); }
  /// The error over what is allowed, with room for estimates that are too small: half of the true error is not rare
  /// (docs/methods/accuracy.md).
  double excess() const {
    constexpr double safety = 2;
    return safety * error / allowed();
  }
  bool is_met() const { return has_estimate && excess() <= 1; }
};

/// One mesh of the sequence.
struct Level {
  std::int64_t cells = 0, nodes = 0, unknowns = 0;
  contact::Status status = contact::Status::solved;
  std::int64_t active = 0;  ///< nodes in contact
  int iterations = 0;       ///< active-set iterations
  int factorisations = 0;
  int linearisations = 1;             ///< of the gaps
  double gap_error = 0;               ///< largest |distance - linearised gap| of the deformed faces in contact [m]
  double energy = 0;                  ///< 1/2 a(U, U) [J]
  int lift_rounds = 0;                ///< how often bounds of gaps were lifted
  double energy_before_lifts = 0;     ///< energy of the solution with bounds at 0; `energy` where none was lifted [J]
  double reaction = 0;                ///< norm of the obstacle's resultant force [N]
  double contact_area = 0;            ///< [m^2]
  double max_normal_rotation = 0;     ///< max |r . a_3|
  double multiplier_norm = 0;         ///< of lambda [N m]
  double min_gap = 0;                 ///< at nodes [m]
  double linear_residual = 0;         ///< of the last linear solve, relative
  contact::Tolerances tolerances{};   ///< that bounds and signs were held to
  double max_rotation = 0;            ///< max |r| [rad]
  estimation::Linearity linearity{};  ///< of a solution that was found
  std::vector<GoalRecord> goals{};    ///< where accuracy is asked for
  std::vector<contact::Iteration> history{};
  Seconds seconds{};
};

/// Displacements, resultants, reaction at a named point.
struct ProbeValue {
  std::string name;
  recovery::PointValues values;
};

/// The finest solution, kept for output and further work.
struct Solution {
  std::unique_ptr<assembly::DiscreteShell> discrete;
  certificate::NodalSolution nodal;
  recovery::Choice recovery{};  ///< of the fields; see choose_recovery()
  /// Squared error in the energy norm of each owned cell, estimated [J]; empty where nobody wanted to know.
  std::vector<double> cell_errors{};
  std::vector<certificate::CellGap> entered{};  ///< this rank's cells with a gap below 0 somewhere
};

/// The solution at the end of a step, or of a part of one.
struct HistoryEntry {
  std::string step;  ///< its name
  double time = 0;   ///< steps that are over, the part of this one included
  double load_factor = 1;
  contact::Status status = contact::Status::solved;
  std::string missed_limits{};
  Level level;  ///< how it was computed
  certificate::Summary summary;
  std::vector<ProbeValue> probes{};
};

struct Result {
  contact::Status status = contact::Status::solved;
  std::string missed_limits{};  ///< rows of the certificate beyond their limits, in words; empty unless inaccurate
  certificate::Summary summary{};
  certificate::Certificate certificate{};
  std::vector<certificate::CertificateLimit> limits{};        ///< of its rows
  std::vector<ProbeValue> probes{};                           ///< the same on every rank
  recovery::StressPeak peak{};                                ///< of the last solution
  std::vector<certificate::SingularPlace> singular_places{};  ///< that the peak leaves out
  std::vector<Level> levels{};                                ///< of the first instant, where there are steps
  std::vector<HistoryEntry> history{};  ///< on the finest mesh, instant after instant; empty without steps
  bool has_obstacle = false;
  element::Formulation formulation = element::Formulation::tangent;
  int ranks = 1;
  std::vector<std::string> warnings{};  ///< what to doubt in the result, in words for the user
  double peak_memory = 0;               ///< over all ranks together [bytes]
  std::optional<Solution> solution{};   ///< empty when nothing could be solved
  /// Of the errors of the last solution; empty where there is none, or where nobody wanted to know.
  std::optional<estimation::Estimates> estimates{};

  /// How the solution was found: on the finest mesh, at the last instant.
  const Level& last_level() const { return history.empty() ? levels.back() : history.back().level; }
  /// The largest eta at nodes where it is a density, not at those of lines that touch; NaN if there are only lines [Pa].
  double max_pressure() const;
};

/// How it ended, in a sentence or two.
std::string status_text(const Result& result);

}  // namespace plastron::computation

// The requested quantities on one mesh: values, estimated errors, tolerances.
#pragma once
#include <plastron/estimation/estimates.hpp>
#include <plastron/estimation/functionals.hpp>
#include <plastron/solution/summary.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace plastron::estimation {

/// A requested quantity, as computed on one mesh.
struct GoalRecord {
  std::string name{};
  double value = 0;
  double difference = 0;  ///< exact value minus `value`, with sign if known
  double error = 0;       ///< estimate of |exact value - value|
  double tolerance = 0;   ///< tolerance of the error, relative to `scale`
  double scale = 0;       ///< relative_scale()
  double dual_energy = 0;
  bool has_estimate = true;

  double relative_estimate() const { return scale > 0 ? error / scale : 0; }
  /// Allowed absolute error. Without any forces it is nearly zero.
  double allowed() const { return std::max(tolerance * scale, std::numeric_limits<double>::min()); }
  /// Error divided by the allowed error, with a safety factor: estimates are often only half of the true error
  /// (docs/methods/accuracy.md).
  double excess() const {
    constexpr double safety = 2;
    return safety * error / allowed();
  }
  bool is_met() const { return has_estimate && excess() <= 1; }
};

/// Returns the scale of a goal's relative errors: the size of its value, or a part of usual values of its kind if that is larger.
double relative_scale(const Goal& goal, const GoalEstimate& found, const solution::Summary& summary);

/// Returns the records of goals on the mesh whose solution `summary` describes. Precondition: each goal has a tolerance.
std::vector<GoalRecord> goal_records(const std::vector<Goal>& goals, const Estimates& estimates,
                                     const solution::Summary& summary);

/// Returns a text on the goals that are not met, with their errors, and on unjudged cells; empty if all goals are met.
std::string shortfall(const std::vector<GoalRecord>& goals, const Estimates& estimates);

}  // namespace plastron::estimation

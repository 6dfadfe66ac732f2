#include <plastron/estimation/goal_record.hpp>

#include <fmt/format.h>

#include <cmath>
#include <variant>

namespace plastron::estimation {

namespace {

/// Returns the sum of the norms of the obstacles' forces [N].
double obstacle_forces(const solution::Summary& summary) {
  double sum = 0;
  for (const solution::ObstacleContact& obstacle : summary.obstacles) sum += obstacle.reaction.force.norm();
  return sum;
}

/// Returns the scale of relative errors where the value itself is smaller. Components that vanish by symmetry have no
/// correct digits. The same is true for the sum of obstacles that press against each other.
double least_scale(const Functional& functional, const solution::Summary& summary) {
  constexpr double as_good_as_zero = 1e-3;  // part of the largest value of its kind
  const double forces = std::max(summary.load_norms, obstacle_forces(summary));
  if (const auto* force = std::get_if<ObstacleForce>(&functional))
    return force->obstacle || force->component ? as_good_as_zero * forces : obstacle_forces(summary);
  if (std::holds_alternative<SupportForce>(functional)) return as_good_as_zero * forces;
  if (const auto* point = std::get_if<PointDisplacement>(&functional))
    return as_good_as_zero * (point->component < 3 ? summary.max_displacement : summary.max_rotation);
  return std::holds_alternative<ObstaclePosition>(functional) ? as_good_as_zero * summary.max_displacement : 0;
}

/// Returns a scale below which values are only rounding. By Cauchy and Schwarz, a linear quantity of a solution with
/// this energy is at most 2 sqrt(E E_z), with E_z the energy of its dual. A value below 1e-5 of this bound vanishes,
/// usually by symmetry. For point resultants the bound grows as cells shrink, and the limit is a thousandth of usual
/// values. The whole energy of an unstrained shell vanishes.
double rounding_scale(const Functional& functional, const GoalEstimate& found, const solution::Summary& summary) {
  constexpr double vanishing = 1e-5;
  if (std::holds_alternative<Energy>(functional))
    return summary.is_unstrained ? (summary.load_norms + obstacle_forces(summary)) * summary.max_displacement : 0;
  return vanishing * 2 * std::sqrt(summary.energy.total() * found.dual_energy);
}

}  // namespace

std::vector<GoalRecord> goal_records(const std::vector<Goal>& goals, const Estimates& estimates,
                                     const solution::Summary& summary) {
  std::vector<GoalRecord> records;
  for (std::size_t g = 0; g < goals.size(); ++g) {
    const GoalEstimate& found = estimates.goals[g];
    const double least =
        std::max(least_scale(goals[g].functional, summary), rounding_scale(goals[g].functional, found, summary));
    records.push_back({.name = found.name,
                       .value = found.value,
                       .difference = found.difference(),
                       .error = found.error(),
                       .tolerance = goals[g].tolerance.value(),
                       .scale = std::max(std::abs(found.value), least),
                       .dual_energy = found.dual_energy,
                       .has_estimate = found.has_dual});
  }
  return records;
}

std::string shortfall(const std::vector<GoalRecord>& goals, const Estimates& estimates) {
  std::string text;
  for (const GoalRecord& goal : goals) {
    if (goal.is_met()) continue;
    text += text.empty() ? "" : "; ";
    text += goal.has_estimate ? fmt::format("{}: the estimated error is {:.2g} of its value, which may be half of {:g}",
                                            goal.name, goal.relative_estimate(), goal.tolerance)
                              : fmt::format("{}: its error cannot be estimated", goal.name);
  }
  if (estimates.unjudged_cells > 0)
    text += fmt::format("{}{} cells have no neighbours to judge their errors by", text.empty() ? "" : "; ",
                        estimates.unjudged_cells);
  return text;
}

}  // namespace plastron::estimation

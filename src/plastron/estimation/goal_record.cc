#include <plastron/estimation/goal_record.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace plastron::estimation {

namespace {

constexpr double as_good_as_zero = 1e-3;  ///< part of the largest value of its kind

/// Returns the sum of the norms of the obstacles' forces [N].
double obstacle_forces(const solution::Summary& summary) {
  double sum = 0;
  for (const solution::ObstacleContact& obstacle : summary.obstacles) sum += obstacle.reaction.force.norm();
  return sum;
}

/// Usual values of each kind. Components that vanish by symmetry have no correct digits. The same is true for the sum of
/// obstacles that press against each other, and of forces round a closed shell.
struct UsualValues {
  const solution::Summary& summary;

  double operator()(const Energy& /*energy*/) const {
    // The whole energy of an unstrained shell is rounding: only strains as large as the displacements count.
    const double rigid =
        summary.is_unstrained ? summary.force_scale() * summary.max_displacement + summary.rigid_energy : 0;
    return std::max(summary.least_energy(), rigid);
  }
  double operator()(const LoadWork& /*work*/) const {
    return std::max(summary.least_energy(), as_good_as_zero * summary.load_norms * summary.max_displacement);
  }
  double operator()(const ObstacleForce& force) const {
    const double sum = as_good_as_zero * summary.force_scale();
    return force.obstacle || force.component ? sum : std::max(sum, obstacle_forces(summary));
  }
  double operator()(const SupportForce& /*force*/) const { return as_good_as_zero * summary.force_scale(); }
  double operator()(const ContactArea& /*area*/) const { return 0; }
  double operator()(const PointDisplacement& point) const {
    const double least = summary.least_displacement();
    return point.component < 3 ? std::max(as_good_as_zero * summary.max_displacement, least)
                               : std::max(as_good_as_zero * summary.max_rotation, least / summary.size);
  }
  double operator()(const PointStress& stress) const {
    const double force = as_good_as_zero * summary.force_scale() / summary.size;  // per length
    if (stress.kind != StressKind::resultant) return force / summary.least_thickness;
    return stress.component < 3 || stress.component > 5 ? force : force * summary.least_thickness;
  }
  double operator()(const LargestStress& /*stress*/) const {
    return as_good_as_zero * summary.force_scale() / (summary.size * summary.least_thickness);
  }
  double operator()(const ObstaclePosition& /*position*/) const {
    return std::max(as_good_as_zero * summary.max_displacement, summary.least_displacement());
  }
};

/// Returns a scale below which values are only rounding. By Cauchy and Schwarz, a linear quantity of a solution with
/// this energy is at most 2 sqrt(E E_z), with E_z the energy of its dual. A value below 1e-5 of this bound vanishes,
/// usually by symmetry. For point resultants the bound grows as cells shrink, and the limit is a thousandth of usual
/// values.
double rounding_scale(const Functional& functional, const GoalEstimate& found, const solution::Summary& summary) {
  constexpr double vanishing = 1e-5;
  if (std::holds_alternative<Energy>(functional)) return 0;
  return vanishing * 2 * std::sqrt(summary.energy.total() * found.dual_energy);
}

}  // namespace

double relative_scale(const Goal& goal, const GoalEstimate& found, const solution::Summary& summary) {
  return std::max({std::abs(found.value), std::visit(UsualValues{summary}, goal.functional),
                   rounding_scale(goal.functional, found, summary)});
}

std::vector<GoalRecord> goal_records(const std::vector<Goal>& goals, const Estimates& estimates,
                                     const solution::Summary& summary) {
  std::vector<GoalRecord> records;
  for (std::size_t g = 0; g < goals.size(); ++g) {
    const GoalEstimate& found = estimates.goals[g];
    records.push_back({.name = found.name,
                       .value = found.value,
                       .difference = found.difference(),
                       .error = found.error(),
                       .tolerance = goals[g].tolerance.value(),
                       .scale = relative_scale(goals[g], found, summary),
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
    text += goal.has_estimate
                ? fmt::format("{}: the estimated error is {:.2g} of {}, which may be half of {:g}", goal.name,
                              goal.relative_estimate(),
                              goal.scale > 2 * std::abs(goal.value) ? "usual values" : "its value", goal.tolerance)
                : fmt::format("{}: its error cannot be estimated", goal.name);
  }
  if (estimates.unjudged_cells > 0)
    text += fmt::format("{}{} cells have no neighbours to judge their errors by", text.empty() ? "" : "; ",
                        estimates.unjudged_cells);
  return text;
}

}  // namespace plastron::estimation

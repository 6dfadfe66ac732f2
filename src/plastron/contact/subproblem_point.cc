#include <plastron/contact/pressing.hpp>
#include <plastron/contact/subproblem_point.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::contact {
namespace {

constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

bool is_bounded(const BoxProblem& problem, std::size_t i) {
  const double lower = problem.lower.owned()[i], upper = problem.upper.owned()[i];
  return lower != upper && (std::isfinite(lower) || std::isfinite(upper));
}

// Sets the larger of two limits: the requested tolerance, a multiple of the largest bounded unknown, and the rounding
// of an unknown. Unknowns of different units are compared by the energy sqrt(A_ii) |z_i|. Its rounding is a few eps of
// the largest value anywhere. Hence the result depends neither on the unit of length nor on rotations.
void measure_gap_noise(const BoxProblem& problem, const Settings& settings, const algebra::Vector& scale,
                       SubproblemPoint& point) {
  constexpr double rounding = 16 * machine_epsilon;
  double largest = 0, energy = 0;
  const std::span<const double> z = point.z.owned(), diagonal = scale.owned();
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (is_bounded(problem, i)) largest = std::max(largest, std::abs(z[i]));
    if (diagonal[i] > 0) energy = std::max(energy, std::sqrt(diagonal[i]) * std::abs(z[i]));
  }
  const MPI_Comm comm = point.z.layout()->comm;
  largest = algebra::max_over_ranks(largest, comm);
  energy = algebra::max_over_ranks(energy, comm);
  const double asked =
      (point.has_converged ? settings.gap_tolerance : std::max(settings.gap_tolerance, point.linear_residual)) *
      largest;
  point.gap_noise = algebra::Vector(point.z.layout(), point.z.block());
  double loosest = asked;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (!is_bounded(problem, i)) continue;
    double& noise = point.gap_noise.owned()[i];
    noise = diagonal[i] > 0 ? std::max(asked, rounding * energy / std::sqrt(diagonal[i])) : asked;
    loosest = std::max(loosest, noise);
  }
  loosest = algebra::max_over_ranks(loosest, comm);
  point.tolerances.gap = largest > 0 ? loosest / largest : settings.gap_tolerance;
}

// Sets the larger of the requested tolerance and the rounding of A z - b. The rounding is eps |A| |z| times a
// factor. The residuals of the free unknowns show this factor, since they would be zero without rounding. The diagonal
// makes forces and moments comparable.
void measure_multiplier_noise(const BoxProblem& problem, const Settings& settings, const algebra::Vector& scale,
                              const ActiveSet& set, SubproblemPoint& point) {
  algebra::Vector& noise = point.multiplier_noise;
  noise = algebra::Vector(point.z.layout(), point.z.block());
  problem.matrix.multiply_absolute(point.z, noise);
  double residual = 0;
  double rounding = 0;
  double largest = 0;
  double energy = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double multiplier = std::abs(point.multiplier.owned()[i]);
    double& value = noise.owned()[i];
    energy = std::max(energy, std::sqrt(std::max(scale.owned()[i], 0.0)) * std::abs(point.z.owned()[i]));
    value = machine_epsilon * (value + std::abs(problem.load.owned()[i]));
    if (set[i] == Activity::free && scale.owned()[i] > 0) {
      residual += multiplier * multiplier / scale.owned()[i];
      rounding += value * value / scale.owned()[i];
    }
    if (set[i] == Activity::at_lower || set[i] == Activity::at_upper) largest = std::max(largest, multiplier);
  }
  const MPI_Comm comm = point.z.layout()->comm;
  residual = std::sqrt(algebra::sum_over_ranks(residual, comm));
  // If symmetry cancels entries of A, the rounding of A z is still a few eps of the largest energy.
  rounding = std::max(std::sqrt(algebra::sum_over_ranks(rounding, comm)),
                      machine_epsilon * algebra::max_over_ranks(energy, comm));
  const double factor = 4 * std::max(1.0, rounding > 0 ? residual / rounding : 1.0);
  largest = algebra::max_over_ranks(largest, comm);
  const double asked = settings.multiplier_tolerance * largest;
  double loosest = asked;
  for (std::size_t i = 0; i < set.size(); ++i) {
    double& value = noise.owned()[i];
    value = std::max(asked, factor * value);
    if (set[i] == Activity::at_lower || set[i] == Activity::at_upper) loosest = std::max(loosest, value);
  }
  loosest = algebra::max_over_ranks(loosest, comm);
  point.tolerances.multiplier = largest > 0 ? loosest / largest : settings.multiplier_tolerance;
}

}  // namespace

SubproblemPoint assess(const BoxProblem& problem, const Settings& settings, const algebra::Vector& diagonal,
                       algebra::Vector z, const algebra::CgResult& linear, const ActiveSet& set) {
  SubproblemPoint point{.z = std::move(z), .multiplier = linear.residual};
  for (double& value : point.multiplier.owned()) value = -value;
  point.energy = 0.5 * (algebra::dot(point.z, point.multiplier) - algebra::dot(point.z, problem.load));
  point.linear_residual = linear.relative_residual;
  point.linear_steps = linear.steps;
  point.has_converged = linear.converged;
  measure_gap_noise(problem, settings, diagonal, point);
  measure_multiplier_noise(problem, settings, diagonal, set, point);
  return point;
}

Verdict judge(const BoxProblem& problem, const SubproblemPoint& point, const ActiveSet& set) {
  Verdict verdict{.next = set};
  const auto z = point.z.owned();
  std::int64_t violations = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i] == Activity::prescribed) continue;
    if (set[i] == Activity::free) {
      const double below = problem.lower.owned()[i] - z[i];
      const double above = z[i] - problem.upper.owned()[i];
      verdict.worst_violation = std::max({verdict.worst_violation, below, above});
      const double noise = point.gap_noise.owned()[i];
      if (below > noise) verdict.next[i] = Activity::at_lower;
      if (above > noise) verdict.next[i] = Activity::at_upper;
      violations += below > noise || above > noise;
    } else {
      const double multiplier = (set[i] == Activity::at_lower ? 1 : -1) * point.multiplier.owned()[i];
      verdict.worst_multiplier = std::min(verdict.worst_multiplier, multiplier);
      if (multiplier < -point.multiplier_noise.owned()[i]) verdict.next[i] = Activity::free;
    }
  }
  for (const Touch& touch : point.touched) verdict.next[touch.unknown] = touch.activity;
  const MPI_Comm comm = problem.load.layout()->comm;
  verdict.is_feasible = algebra::sum_over_ranks(violations, comm) == 0;
  verdict.worst_violation = algebra::max_over_ranks(verdict.worst_violation, comm);
  verdict.worst_multiplier = algebra::min_over_ranks(verdict.worst_multiplier, comm);
  return verdict;
}

BoxSolution unsolved(const BoxProblem& problem, Status status) {
  assert_fits_together(problem);
  const algebra::Vector zero(problem.load.layout(), problem.load.block());
  return {.status = status,
          .z = zero,
          .multiplier = zero,
          .activity = starting_set(problem, {}),
          .positions = std::vector<double>(problem.pressing.size(), 0.0),
          .iterations = {},
          .linear_residual = 0};
}

std::int64_t record(const BoxProblem& problem, SubproblemPoint point, const ActiveSet& set, const Verdict& verdict,
                    const Observer& observer, BoxSolution& solution) {
  solution.iterations.push_back({.active = count_active(problem, set),
                                 .changes = count_changes(problem, set, verdict.next),
                                 .energy = point.energy,
                                 .worst_violation = verdict.worst_violation,
                                 .worst_multiplier = verdict.worst_multiplier,
                                 .linear_steps = point.linear_steps});
  solution.z = std::move(point.z);
  solution.multiplier = std::move(point.multiplier);
  solution.equation_multiplier = std::move(point.equation_multiplier);
  solution.activity = set;
  solution.positions = std::move(point.positions);
  solution.linear_residual = point.linear_residual;
  solution.tolerances = point.tolerances;
  if (observer.iteration) observer.iteration(solution.iterations.back());
  return solution.iterations.back().changes;
}

}  // namespace plastron::contact

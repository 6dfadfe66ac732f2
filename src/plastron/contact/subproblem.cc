#include <plastron/algebra/assertion.hpp>
#include <plastron/contact/kept_factor.hpp>
#include <plastron/contact/subproblem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::contact {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// A linear solve that ends above this relative residual is a failure; below it, rounding may excuse a missed
/// tolerance.
constexpr double usable_residual = 1e-6;

std::vector<char> held(const ActiveSet& set) {
  std::vector<char> marks(set.size());
  std::ranges::transform(set, marks.begin(), [](Activity activity) { return activity != Activity::free; });
  return marks;
}

/// An exact preconditioner leaves rounding to be refined. Any other makes residuals fall by fits and starts, slowly.
algebra::CgSettings linear_settings(const Settings& settings, const algebra::Preconditioner& preconditioner) {
  constexpr int patience = 200;
  if (preconditioner.is_exact())
    return {.tolerance = settings.linear_tolerance, .max_steps = settings.max_refinement_steps};
  return {.tolerance = settings.linear_tolerance, .max_steps = settings.max_iterative_steps, .patience = patience};
}

/// What it means for a subproblem that the preconditioner could not be pinned.
Status failure_of(algebra::Pinning pinning) {
  switch (pinning) {
    case algebra::Pinning::not_finite:
      return Status::not_finite;
    case algebra::Pinning::not_converged:
      return Status::linear_solver_stalled;
    default:
      return Status::singular;
  }
}

}  // namespace

SubproblemSolver::SubproblemSolver(const BoxProblem& problem, algebra::Preconditioner& preconditioner,
                                   const Settings& settings)
    : problem_(problem), preconditioner_(preconditioner), settings_(settings), diagonal_(problem.matrix.diagonal()) {
  if (problem_.equations) q_ = problem_.equations->multipliers;
}

std::optional<SubproblemPoint> SubproblemSolver::solve(const ActiveSet& set) {
  PLASTRON_ASSERT(set.size() == problem_.load.owned().size(), set.size(), problem_.load.owned().size());
  if (auto point = solve_with_kept_factor(set)) return point;
  if (!pin(set)) return {};
  algebra::Vector z(problem_.load.layout(), problem_.load.block());
  const auto linear = problem_.equations
                          ? solve_with_equations(set, z)
                          : solve_linear(set, problem_.load, linear_settings(settings_, preconditioner_), z);
  failure_ = std::isfinite(linear.relative_residual) ? Status::linear_solver_stalled : Status::not_finite;
  if (!linear.converged && !(linear.relative_residual <= usable_residual)) return {};
  return complete(std::move(z), linear, set);
}

bool SubproblemSolver::pin(const ActiveSet& set) {
  const auto fixed = held(set);
  pinned_.reset();
  const algebra::Pinning pinning = preconditioner_.pin(fixed);
  failure_ = failure_of(pinning);
  if (pinning != algebra::Pinning::done) return false;
  if (settings_.detect_free_motions && preconditioner_.softest_motion(problem_.apply, fixed, diagonal_).is_free())
    return false;
  pinned_ = set;
  return true;
}

/// A subproblem that differs from the pinned one in a few unknowns: a preconditioner that was exact there is exact here up to that
/// rank. Its norm weighs the unknowns that changed wrongly, hence the sharper tolerance. Nothing where pinning anew is cheaper, or if
/// that does not converge soon.
std::optional<SubproblemPoint> SubproblemSolver::solve_with_kept_factor(const ActiveSet& set) {
  constexpr double sharper = 1e-2;
  if (settings_.detect_free_motions || problem_.equations || !pinned_ || !preconditioner_.is_exact()) return {};
  const auto unknowns = static_cast<double>(nearby_.layout()->global_size) * nearby_.block();
  const int steps =
      steps_to_try(settings_.kept_factor, preconditioner_.price(), unknowns, count_changes(problem_, *pinned_, set));
  if (steps == 0) return {};
  algebra::Vector z = nearby_;
  const auto linear =
      solve_linear(set, problem_.load,
                   {.tolerance = sharper * settings_.linear_tolerance, .max_steps = steps, .patience = steps}, z);
  if (!linear.converged) return {};
  return complete(std::move(z), linear, set);
}

algebra::CgResult SubproblemSolver::solve_linear(const ActiveSet& set, const algebra::Vector& load,
                                                 const algebra::CgSettings& settings, algebra::Vector& z) const {
  for (std::size_t i = 0; i < set.size(); ++i)
    if (set[i] != Activity::free) z.owned()[i] = held_at(problem_, i, set[i]);
  const auto precondition = [&](const algebra::Vector& r, algebra::Vector& x) { preconditioner_.apply(r, x); };
  return algebra::conjugate_gradients(problem_.apply, precondition, load, held(set), diagonal_, z, settings);
}

/// The saddle point  A z + B' q = b,  B z = 0  on a subproblem. For given q, z is a linear solve; then q is corrected by the Schur
/// complement with the preconditioner in place of A (defect correction), which leaves an error of that one's relative error.
/// Ends when the correction has no more energy than rounding has.
algebra::CgResult SubproblemSolver::solve_with_equations(const ActiveSet& set, algebra::Vector& z) {
  constexpr int most_corrections = 30;
  constexpr double negligible = 1e-11;  // of an energy norm
  const EqualityConstraints& equations = *problem_.equations;
  algebra::Vector violation = equations.multipliers;
  algebra::Vector force(z.layout(), z.block());
  double last_gain = std::numeric_limits<double>::infinity();
  int steps = 0;
  for (int correction = 0;; ++correction) {
    q_.update_ghosts();
    equations.apply_transposed(q_, force);
    algebra::Vector load = problem_.load;
    algebra::axpy(-1, force, load);
    auto linear = solve_linear(set, load, linear_settings(settings_, preconditioner_), z);
    steps += linear.steps;
    equations.apply(z, violation);
    algebra::Vector step = equations.multipliers;
    const bool can_hold = multiplier_step(set, violation, step);
    const double gain = std::sqrt(std::max(0.0, algebra::dot(step, violation)));
    algebra::Vector Az = load;
    algebra::axpy(-1, linear.residual, Az);
    const double energy = std::sqrt(std::abs(algebra::dot(z, Az)));
    const bool stagnates = gain > 0.5 * last_gain;
    if (!can_hold || gain <= negligible * energy || stagnates || correction == most_corrections) {
      linear.steps = steps;
      linear.converged = linear.converged && can_hold && gain <= usable_residual * energy;
      linear.relative_residual = std::max(linear.relative_residual, !can_hold ? 1.0 : energy > 0 ? gain / energy : 0.0);
      return linear;
    }
    last_gain = gain;
    algebra::axpy(1, step, q_);
  }
}

/// z = A^{-1} force where nothing is fixed, exact but for rounding only if the preconditioner is. `force` is zero where fixed.
void SubproblemSolver::solve_roughly(std::span<const char> fixed, const algebra::Vector& force,
                                     algebra::Vector& z) const {
  constexpr double tolerance = 1e-8;
  if (preconditioner_.is_exact()) return preconditioner_.apply(force, z);
  z.fill(0);
  const auto precondition = [&](const algebra::Vector& r, algebra::Vector& x) { preconditioner_.apply(r, x); };
  auto settings = linear_settings(settings_, preconditioner_);
  settings.tolerance = tolerance;
  algebra::conjugate_gradients(problem_.apply, precondition, force, fixed, diagonal_, z, settings);
}

/// Roughly (B A^{-1} B')^{-1} times a violation of the equations, by conjugate gradients with the preconditioner for A. False if the
/// equations cannot hold on this subproblem.
bool SubproblemSolver::multiplier_step(const ActiveSet& set, const algebra::Vector& violation,
                                       algebra::Vector& step) const {
  constexpr double tolerance = 1e-4, hopeless = 0.1;
  const EqualityConstraints& equations = *problem_.equations;
  const auto fixed = held(set);
  algebra::Vector force(problem_.load.layout(), problem_.load.block()), z = force;
  const auto schur = [&](const algebra::Vector& q, algebra::Vector& result) {
    equations.apply_transposed(q, force);
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i]) force.owned()[i] = 0;
    solve_roughly(fixed, force, z);
    z.update_ghosts();
    equations.apply(z, result);
  };
  const auto result = algebra::conjugate_gradients(schur, equations.precondition, violation, {}, {}, step,
                                                   {.tolerance = tolerance, .max_steps = 60, .patience = 20});
  return result.converged || result.relative_residual < hopeless;
}

SubproblemPoint SubproblemSolver::complete(algebra::Vector z, const algebra::CgResult& linear, const ActiveSet& set) {
  nearby_ = z;
  SubproblemPoint point{.z = std::move(z), .multiplier = linear.residual};
  if (problem_.equations) point.equation_multiplier = q_;
  for (double& value : point.multiplier.owned()) value = -value;
  point.energy = 0.5 * (algebra::dot(point.z, point.multiplier) - algebra::dot(point.z, problem_.load));
  point.linear_residual = linear.relative_residual;
  point.linear_steps = linear.steps;
  point.has_converged = linear.converged;
  measure_gap_noise(point);
  measure_multiplier_noise(point, set);
  return point;
}

bool SubproblemSolver::is_bounded(std::size_t i) const {
  const double lower = problem_.lower.owned()[i], upper = problem_.upper.owned()[i];
  return lower < upper && (std::isfinite(lower) || std::isfinite(upper));
}

// The larger of the tolerance asked for, a multiple of the largest unknown that has a bound, and of what rounding leaves of
// an unknown. Unknowns of other units are compared by the energy sqrt(A_ii) |z_i|, of which rounding spoils a few eps of the
// largest anywhere: so neither the unit of length nor rotations decide.
void SubproblemSolver::measure_gap_noise(SubproblemPoint& point) const {
  constexpr double rounding = 16 * epsilon;
  double largest = 0, energy = 0;
  const std::span<const double> z = point.z.owned(), diagonal = diagonal_.owned();
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (is_bounded(i)) largest = std::max(largest, std::abs(z[i]));
    if (diagonal[i] > 0) energy = std::max(energy, std::sqrt(diagonal[i]) * std::abs(z[i]));
  }
  const MPI_Comm comm = point.z.layout()->comm;
  largest = algebra::max_over_ranks(largest, comm);
  energy = algebra::max_over_ranks(energy, comm);
  const double asked =
      (point.has_converged ? settings_.gap_tolerance : std::max(settings_.gap_tolerance, point.linear_residual)) *
      largest;
  point.gap_noise = algebra::Vector(point.z.layout(), point.z.block());
  double loosest = asked;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (!is_bounded(i)) continue;
    double& noise = point.gap_noise.owned()[i];
    noise = diagonal[i] > 0 ? std::max(asked, rounding * energy / std::sqrt(diagonal[i])) : asked;
    loosest = std::max(loosest, noise);
  }
  loosest = algebra::max_over_ranks(loosest, comm);
  point.tolerances.gap = largest > 0 ? loosest / largest : settings_.gap_tolerance;
}

// The larger of the tolerance asked for and what rounding does to A z - b. The latter goes like eps |A| |z|, with a
// factor that the residuals of the free unknowns show, since they would be zero without rounding; forces and moments
// are made comparable by the diagonal.
void SubproblemSolver::measure_multiplier_noise(SubproblemPoint& point, const ActiveSet& set) const {
  algebra::Vector& noise = point.multiplier_noise;
  noise = algebra::Vector(point.z.layout(), point.z.block());
  problem_.matrix.multiply_absolute(point.z, noise);
  double residual = 0;
  double rounding = 0;
  double largest = 0;
  double energy = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double multiplier = std::abs(point.multiplier.owned()[i]);
    double& value = noise.owned()[i];
    energy = std::max(energy, std::sqrt(std::max(diagonal_.owned()[i], 0.0)) * std::abs(point.z.owned()[i]));
    value = epsilon * (value + std::abs(problem_.load.owned()[i]));
    if (set[i] == Activity::free && diagonal_.owned()[i] > 0) {
      residual += multiplier * multiplier / diagonal_.owned()[i];
      rounding += value * value / diagonal_.owned()[i];
    }
    if (set[i] == Activity::at_lower || set[i] == Activity::at_upper) largest = std::max(largest, multiplier);
  }
  const MPI_Comm comm = point.z.layout()->comm;
  residual = std::sqrt(algebra::sum_over_ranks(residual, comm));
  // Where symmetry cancels entries of A, A z is still rounded by a few eps of the largest energy.
  rounding =
      std::max(std::sqrt(algebra::sum_over_ranks(rounding, comm)), epsilon * algebra::max_over_ranks(energy, comm));
  const double factor = 4 * std::max(1.0, rounding > 0 ? residual / rounding : 1.0);
  largest = algebra::max_over_ranks(largest, comm);
  const double asked = settings_.multiplier_tolerance * largest;
  double loosest = asked;
  for (std::size_t i = 0; i < set.size(); ++i) {
    double& value = noise.owned()[i];
    value = std::max(asked, factor * value);
    if (set[i] == Activity::at_lower || set[i] == Activity::at_upper) loosest = std::max(loosest, value);
  }
  loosest = algebra::max_over_ranks(loosest, comm);
  point.tolerances.multiplier = largest > 0 ? loosest / largest : settings_.multiplier_tolerance;
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
  const MPI_Comm comm = problem.load.layout()->comm;
  verdict.is_feasible = algebra::sum_over_ranks(violations, comm) == 0;
  verdict.worst_violation = algebra::max_over_ranks(verdict.worst_violation, comm);
  verdict.worst_multiplier = algebra::min_over_ranks(verdict.worst_multiplier, comm);
  return verdict;
}

}  // namespace plastron::contact

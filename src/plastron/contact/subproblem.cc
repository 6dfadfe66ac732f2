#include <plastron/algebra/assertion.hpp>
#include <plastron/contact/kept_factor.hpp>
#include <plastron/contact/subproblem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::contact {
namespace {

/// Limit of the relative residual of a linear solve. Above it the solve is a failure; below it, rounding may explain a
/// missed tolerance.
constexpr double usable_residual = 1e-6;

/// Returns the settings of a linear solve. An exact preconditioner leaves only rounding to reduce; with any other,
/// residuals decrease slowly and irregularly.
algebra::CgSettings linear_settings(const Settings& settings, const algebra::Preconditioner& preconditioner) {
  constexpr int patience = 200;
  if (preconditioner.is_exact())
    return {.tolerance = settings.linear_tolerance, .max_steps = settings.max_refinement_steps};
  return {.tolerance = settings.linear_tolerance, .max_steps = settings.max_iterative_steps, .patience = patience};
}

}  // namespace

std::vector<char> held(const ActiveSet& set) {
  std::vector<char> marks(set.size());
  std::ranges::transform(set, marks.begin(), [](Activity activity) { return activity != Activity::free; });
  return marks;
}

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

SubproblemSolver::SubproblemSolver(const BoxProblem& problem, algebra::Preconditioner& preconditioner,
                                   const Settings& settings)
    : problem_(problem), preconditioner_(preconditioner), settings_(settings), diagonal_(problem.matrix.diagonal()) {
  if (problem_.equations) q_ = problem_.equations->multipliers;
}

std::optional<SubproblemPoint> SubproblemSolver::solve_first(std::span<const Activity> initial) {
  auto point = solve(starting_set(problem_, initial));
  return point ? std::move(point) : solve(everything_active(problem_));
}

std::optional<SubproblemPoint> SubproblemSolver::solve(const ActiveSet& set) {
  PLASTRON_ASSERT(set.size() == problem_.load.owned().size(), set.size(), problem_.load.owned().size());
  follow(set);
  if (auto point = solve_with_kept_factor(set)) return point;
  return solve_anew(set);
}

/// Pins unknowns where this costs little, so that the preconditioner approximates `set` as well as possible without
/// being made anew.
void SubproblemSolver::follow(const ActiveSet& set) {
  if (settings_.detect_free_motions || !pinned_) return;
  const std::vector<char> pins = preconditioner_.nearest_pins(held(set));
  if (pins.empty()) return;
  ActiveSet nearest = set;
  for (std::size_t i = 0; i < set.size(); ++i)
    if (pins[i] != (set[i] != Activity::free)) nearest[i] = (*pinned_)[i];
  if (preconditioner_.pin(pins, problem_.shift) == algebra::Pinning::done)
    pinned_ = std::move(nearest);
  else
    pinned_.reset();
}

std::optional<SubproblemPoint> SubproblemSolver::solve_anew(const ActiveSet& set) {
  if (!pin(set)) return {};
  return refine(set, algebra::Vector(problem_.load.layout(), problem_.load.block()));
}

std::optional<SubproblemPoint> SubproblemSolver::refine(const ActiveSet& set, algebra::Vector z) {
  hold(set, z);
  const auto linear = solve_pinned(set, problem_.load, q_, z);
  if (!is_usable(linear)) return {};
  return complete(std::move(z), linear, set);
}

std::optional<algebra::CgResult> SubproblemSolver::response(const ActiveSet& set, const algebra::Vector& values,
                                                            algebra::Vector& z) {
  const algebra::Vector no_load(problem_.load.layout(), problem_.load.block());
  algebra::Vector q = problem_.equations ? problem_.equations->multipliers : algebra::Vector();
  z = no_load;
  for (std::size_t i = 0; i < set.size(); ++i)
    if (set[i] != Activity::free) z.owned()[i] = values.owned()[i];
  auto linear = solve_pinned(set, no_load, q, z);
  if (!is_usable(linear)) return {};
  return linear;
}

bool SubproblemSolver::is_usable(const algebra::CgResult& linear) {
  failure_ = std::isfinite(linear.relative_residual) ? Status::linear_solver_stalled : Status::not_finite;
  return linear.converged || linear.relative_residual <= usable_residual;
}

bool SubproblemSolver::pin(const ActiveSet& set) {
  const auto fixed = held(set);
  pinned_.reset();
  const algebra::Pinning pinning = preconditioner_.pin(fixed, problem_.shift);
  failure_ = failure_of(pinning);
  if (pinning != algebra::Pinning::done) return false;
  if (settings_.detect_free_motions && preconditioner_.softest_motion(problem_.apply, fixed, diagonal_).is_free())
    return false;
  pinned_ = set;
  return true;
}

/// Solves a subproblem that differs from the pinned one in a few unknowns. An exact preconditioner of the pinned one is
/// exact here up to a matrix of this rank. Its norm gives wrong weights to the changed unknowns, hence the smaller
/// tolerance. Nothing where pinning anew is cheaper, or if the iteration does not converge soon.
std::optional<SubproblemPoint> SubproblemSolver::solve_with_kept_factor(const ActiveSet& set) {
  constexpr double sharper = 1e-2;
  if (settings_.detect_free_motions || problem_.equations || !pinned_ || !nearby_.layout()) return {};
  if (!preconditioner_.is_exact()) return {};
  const auto unknowns = static_cast<double>(nearby_.layout()->global_size) * nearby_.block();
  const std::int64_t changes = count_changes(problem_, *pinned_, set);
  if (changes == 0) return refine(set, algebra::Vector(nearby_.layout(), nearby_.block()));
  const int steps = steps_to_try(settings_.kept_factor, preconditioner_.price(), unknowns, changes);
  if (steps == 0) return {};
  algebra::Vector z = nearby_;
  hold(set, z);
  const auto linear =
      solve_linear(set, problem_.load,
                   {.tolerance = sharper * settings_.linear_tolerance, .max_steps = steps, .patience = steps}, z);
  if (!linear.converged) return {};
  return complete(std::move(z), linear, set);
}

void SubproblemSolver::hold(const ActiveSet& set, algebra::Vector& z) const {
  for (std::size_t i = 0; i < set.size(); ++i)
    if (set[i] != Activity::free) z.owned()[i] = held_at(problem_, i, set[i]);
}

/// Solves for z, which has the values of the fixed unknowns on entry.
algebra::CgResult SubproblemSolver::solve_linear(const ActiveSet& set, const algebra::Vector& load,
                                                 const algebra::CgSettings& settings, algebra::Vector& z) const {
  const auto precondition = [&](const algebra::Vector& r, algebra::Vector& x) { preconditioner_.apply(r, x); };
  return algebra::conjugate_gradients(problem_.apply, precondition, load, held(set), diagonal_, z, settings);
}

algebra::CgResult SubproblemSolver::solve_pinned(const ActiveSet& set, const algebra::Vector& load, algebra::Vector& q,
                                                 algebra::Vector& z) const {
  return problem_.equations ? solve_with_equations(set, load, q, z)
                            : solve_linear(set, load, linear_settings(settings_, preconditioner_), z);
}

/// Solves the saddle point  A z + B' q = b,  B z = 0  on a subproblem. For given q, z is a linear solve. Then the Schur
/// complement corrects q with the preconditioner in place of A (defect correction). The remaining error has the
/// relative error of the preconditioner. The solver ends when the energy of the correction is only rounding.
algebra::CgResult SubproblemSolver::solve_with_equations(const ActiveSet& set, const algebra::Vector& right,
                                                         algebra::Vector& q, algebra::Vector& z) const {
  constexpr int most_corrections = 30;
  constexpr double negligible = 1e-11;  // part of an energy norm
  constexpr double hopeless = 0.1;
  const EqualityConstraints& equations = *problem_.equations;
  algebra::Vector violation = equations.multipliers;
  algebra::Vector force(z.layout(), z.block());
  double last_gain = std::numeric_limits<double>::infinity();
  int steps = 0;
  for (int correction = 0;; ++correction) {
    q.update_ghosts();
    equations.apply_transposed(q, force);
    algebra::Vector load = right;
    algebra::axpy(-1, force, load);
    auto linear = solve_linear(set, load, linear_settings(settings_, preconditioner_), z);
    steps += linear.steps;
    equations.apply(z, violation);
    algebra::Vector step = equations.multipliers;
    const auto correcting = multiplier_step(set, violation, step);
    const bool can_hold = correcting.converged || correcting.relative_residual < hopeless;
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
    algebra::axpy(1, step, q);
  }
}

bool SubproblemSolver::solve_increment(const ActiveSet& set, const algebra::Vector& r, algebra::Vector& s) {
  if ((!pinned_ || count_changes(problem_, *pinned_, set) > 0) && !pin(set)) return false;
  s.fill(0);
  const auto precondition = [&](const algebra::Vector& from, algebra::Vector& to) { preconditioner_.apply(from, to); };
  const auto linear = algebra::conjugate_gradients(problem_.apply, precondition, r, held(set), diagonal_, s,
                                                   linear_settings(settings_, preconditioner_));
  return is_usable(linear);
}

/// Computes z = A^{-1} force where nothing is fixed. It is exact up to rounding only if the preconditioner is. `force`
/// is zero where unknowns are fixed.
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

/// Computes approximately (B A^{-1} B')^{-1} times a violation of the equations, by conjugate gradients with the
/// preconditioner for A. A residual that hardly decreases shows that the equations cannot be satisfied on this
/// subproblem.
algebra::CgResult SubproblemSolver::multiplier_step(const ActiveSet& set, const algebra::Vector& violation,
                                                    algebra::Vector& step) const {
  constexpr double tolerance = 1e-4;
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
  return algebra::conjugate_gradients(schur, equations.precondition, violation, {}, {}, step,
                                      {.tolerance = tolerance, .max_steps = 60, .patience = 20});
}

algebra::Vector SubproblemSolver::irreducible(const ActiveSet& set, const algebra::Vector& violation) const {
  algebra::Vector step = problem_.equations->multipliers;
  return multiplier_step(set, violation, step).residual;
}

SubproblemPoint SubproblemSolver::complete(algebra::Vector z, const algebra::CgResult& linear, const ActiveSet& set) {
  nearby_ = z;
  SubproblemPoint point = assess(problem_, settings_, diagonal_, std::move(z), linear, set);
  if (problem_.equations) point.equation_multiplier = q_;
  return point;
}

}  // namespace plastron::contact

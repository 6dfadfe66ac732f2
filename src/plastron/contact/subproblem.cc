#include <plastron/algebra/assertion.hpp>
#include <plastron/contact/subproblem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::contact {
namespace {

/// Limit of the relative residual of a linear solve. Above it the solve is a failure; below it, rounding may explain a
/// missed tolerance.
constexpr double usable_residual = 1e-6;

/// An exact preconditioner leaves only rounding to reduce.
algebra::CgSettings linear_settings(const Settings& settings) {
  return {.tolerance = settings.linear_tolerance, .max_steps = settings.max_refinement_steps};
}

}  // namespace

/// `per_unknown`: operations of a factorisation by one thread that take the same time as one unknown in two products,
/// which form strains.
int affordable_steps(const algebra::Price& price, double unknowns) {
  constexpr double per_unknown = 2200;
  const double step = price.apply + per_unknown * unknowns;
  return step > 0 ? static_cast<int>(price.fix / step) : 0;
}

/// Conjugate gradients need about one step for each changed unknown, fewer where the problem has symmetries.
int steps_to_try(KeptFactor rule, const algebra::Price& price, double unknowns, std::int64_t changes) {
  constexpr int most_steps = 16, most_changes = 64;
  if (rule == KeptFactor::always) return changes <= most_changes ? most_steps : 0;
  const int affordable = std::min(most_steps, affordable_steps(price, unknowns));
  return changes < affordable ? affordable : 0;
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

/// Fixes unknowns where this costs little, so that the preconditioner approximates `set` as well as possible without
/// being made anew.
void SubproblemSolver::follow(const ActiveSet& set) {
  if (settings_.detect_free_motions || !fixed_) return;
  const std::vector<char> marks = preconditioner_.nearest_fixed(fixed_by(set));
  if (marks.empty()) return;
  ActiveSet nearest = set;
  for (std::size_t i = 0; i < set.size(); ++i)
    if (marks[i] != (set[i] != Activity::free)) nearest[i] = (*fixed_)[i];
  if (preconditioner_.fix(marks, problem_.shift))
    fixed_ = std::move(nearest);
  else
    fixed_.reset();
}

std::optional<SubproblemPoint> SubproblemSolver::solve_anew(const ActiveSet& set) {
  if (!fix(set)) return {};
  return refine(set, algebra::Vector(problem_.load.layout(), problem_.load.block()));
}

std::optional<SubproblemPoint> SubproblemSolver::refine(const ActiveSet& set, algebra::Vector z) {
  put_at_bounds(set, z);
  const auto linear = solve_system(set, problem_.load, q_, z);
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
  auto linear = solve_system(set, no_load, q, z);
  if (!is_usable(linear)) return {};
  return linear;
}

bool SubproblemSolver::is_usable(const algebra::CgResult& linear) {
  failure_ = std::isfinite(linear.relative_residual) ? Status::linear_solver_stalled : Status::not_finite;
  return linear.converged || linear.relative_residual <= usable_residual;
}

bool SubproblemSolver::fix(const ActiveSet& set) {
  const auto marks = fixed_by(set);
  fixed_.reset();
  failure_ = Status::singular;
  if (!preconditioner_.fix(marks, problem_.shift)) return false;
  if (settings_.detect_free_motions && preconditioner_.softest_motion(problem_.apply, marks, diagonal_).is_free())
    return false;
  fixed_ = set;
  return true;
}

/// Solves a subproblem that differs in a few unknowns from the one that the preconditioner fixes. The preconditioner is
/// exact here up to a matrix of this rank. Its norm gives wrong weights to the changed unknowns, hence the smaller
/// tolerance. Nothing where a new factor is cheaper, or if the iteration does not converge soon.
std::optional<SubproblemPoint> SubproblemSolver::solve_with_kept_factor(const ActiveSet& set) {
  constexpr double sharper = 1e-2;
  if (settings_.detect_free_motions || problem_.equations || !fixed_ || !nearby_.layout()) return {};
  const auto unknowns = static_cast<double>(nearby_.layout()->global_size) * nearby_.block();
  const std::int64_t changes = count_changes(problem_, *fixed_, set);
  if (changes == 0) return refine(set, algebra::Vector(nearby_.layout(), nearby_.block()));
  const int steps = steps_to_try(settings_.kept_factor, preconditioner_.price(), unknowns, changes);
  if (steps == 0) return {};
  algebra::Vector z = nearby_;
  put_at_bounds(set, z);
  const auto linear =
      solve_linear(set, problem_.load,
                   {.tolerance = sharper * settings_.linear_tolerance, .max_steps = steps, .patience = steps}, z);
  if (!linear.converged) return {};
  return complete(std::move(z), linear, set);
}

void SubproblemSolver::put_at_bounds(const ActiveSet& set, algebra::Vector& z) const {
  for (std::size_t i = 0; i < set.size(); ++i)
    if (set[i] != Activity::free) z.owned()[i] = bound_at(problem_, i, set[i]);
}

/// Solves for z, which has the values of the fixed unknowns on entry.
algebra::CgResult SubproblemSolver::solve_linear(const ActiveSet& set, const algebra::Vector& load,
                                                 const algebra::CgSettings& settings, algebra::Vector& z) const {
  const auto precondition = [&](const algebra::Vector& r, algebra::Vector& x) { preconditioner_.apply(r, x); };
  return algebra::conjugate_gradients(problem_.apply, precondition, load, fixed_by(set), diagonal_, z, settings);
}

algebra::CgResult SubproblemSolver::solve_system(const ActiveSet& set, const algebra::Vector& load, algebra::Vector& q,
                                                 algebra::Vector& z) const {
  return problem_.equations ? solve_with_equations(set, load, q, z)
                            : solve_linear(set, load, linear_settings(settings_), z);
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
    auto linear = solve_linear(set, load, linear_settings(settings_), z);
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

/// Computes approximately (B A^{-1} B')^{-1} times a violation of the equations, by conjugate gradients with the
/// preconditioner for A. A residual that hardly decreases shows that the equations cannot be satisfied on this
/// subproblem.
algebra::CgResult SubproblemSolver::multiplier_step(const ActiveSet& set, const algebra::Vector& violation,
                                                    algebra::Vector& step) const {
  constexpr double tolerance = 1e-4;
  const EqualityConstraints& equations = *problem_.equations;
  const auto fixed = fixed_by(set);
  algebra::Vector force(problem_.load.layout(), problem_.load.block()), z = force;
  const auto schur = [&](const algebra::Vector& q, algebra::Vector& result) {
    equations.apply_transposed(q, force);
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i]) force.owned()[i] = 0;
    preconditioner_.apply(force, z);
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

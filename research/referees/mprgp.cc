// Modified proportioning with reduced gradient projections, preconditioned in the face. One factorisation serves all
// faces. Every other step costs products with A. Sources: Dostal and Schoeberl, Minimizing quadratic functions subject
// to bound constraints with the rate of convergence and finite termination (2005); Dostal, Optimal quadratic
// programming algorithms (2009), both bounds: section 5.8, faces preconditioned: section 5.10; the projected
// conjugate-gradient step: Kruzik, Horak, Cermak, Pospisil, Pecha (2020). Symbols are as in docs/research/mprgp.md.
#include <plastron/algebra/krylov.hpp>
#include <plastron/contact/pressing.hpp>
#include <plastron/contact/searches.hpp>
#include <research/referees/faces.hpp>
#include <research/referees/solvers.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace plastron::referees {
namespace {

using algebra::Vector;
using contact::ActiveSet;
using contact::Activity;
using contact::BoxProblem;
using contact::BoxSolution;
using contact::Observer;
using contact::Settings;
using contact::Status;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Curvature limit, in unknowns of unit diagonal. Below it the stiffness of a motion is only rounding.
constexpr double no_stiffness = 4 * epsilon;
/// Most conjugate-gradient steps and expansions in one face, and number of those without progress that end a face.
constexpr int most_steps = 2000, patience = 200;

/// Proportioning in the unknowns x of ScaledUnknowns, from a feasible point.
class Mprgp {
 public:
  Mprgp(const BoxProblem& problem, const ScaledUnknowns& scaled, const FacePreconditioner& preconditioner,
        const Vector& diagonal, const Settings& settings, const Observer& observer, BoxSolution& solution)
      : problem_(problem),
        scaled_(scaled),
        preconditioner_(preconditioner),
        diagonal_(diagonal),
        settings_(settings),
        observer_(observer),
        solution_(solution),
        x_(scaled.unknowns(solution.z)),
        gradient_(x_),
        z_(x_),
        Ap_(x_),
        s_(x_),
        As_(x_),
        force_(x_),
        original_(x_),
        set_(contact::everything_at_bounds(problem, solution.z)) {
    step_length_ = 1.8 / largest_eigenvalue([this](const Vector& v, Vector& y) { scaled_.apply(v, y); }, x_);
    restart();
    const double energy =
        algebra::dot(x_, gradient_) + algebra::dot(x_, scaled_.load());  // x'Ax: prescribed values alone may move it
    reference_ = std::max(preconditioned_norm(scaled_.load()), std::sqrt(std::max(0.0, energy)));
  }

  Status run() {
    while (!outcome_) {
      if (face_is_solved())
        conclude();
      else if (split_.is_proportional())
        move_in_face();
      else
        let_go(split_.chopped);
      if (!outcome_ && steps_ >= most_steps) outcome_ = Status::linear_solver_stalled;
    }
    return *outcome_;
  }

 private:
  // Recomputes g = A x - b; the next direction is the preconditioned gradient.
  void restart() {
    x_.update_ghosts();
    scaled_.apply(x_, gradient_);
    algebra::axpy(-1, scaled_.load(), gradient_);
    look_around();
    p_ = z_;
  }

  // Computes free and chopped gradient, z = P M^{-1} P phi.
  void look_around() {
    split_gradient(scaled_.lower(), scaled_.upper(), x_, gradient_, step_length_, split_);
    precondition(split_.free, z_);
    for (std::size_t i = 0; i < split_.active.size(); ++i)
      if (split_.active[i]) z_.owned()[i] = 0;
    z_.update_ghosts();
    phi_z_ = algebra::dot(split_.free, z_);
    if (!(phi_z_ >= 0)) outcome_ = std::isfinite(phi_z_) ? Status::linear_solver_stalled : Status::not_finite;
    const double norm = std::sqrt(std::max(0.0, phi_z_));
    since_halved_ = norm < 0.5 * halved_ ? 0 : since_halved_ + 1;
    if (since_halved_ == 0) halved_ = norm;
  }

  // Computes z = M^{-1} r.
  void precondition(const Vector& r, Vector& z) {
    scaled_.original_forces(r, force_);
    preconditioner_.apply(force_, original_);
    scaled_.unknowns(original_, z);
  }

  double preconditioned_norm(const Vector& r) {
    Vector z(r.layout(), r.block());
    precondition(r, z);
    return std::sqrt(std::abs(algebra::dot(r, z)));
  }

  bool face_is_solved() const {
    constexpr double nearly = 1e-9, rounding = 64 * epsilon;
    return std::sqrt(phi_z_) <= std::max(nearly * reference_, rounding * algebra::norm(x_)) || since_halved_ > patience;
  }

  // A step of conjugate gradients, shortened at the box.
  void move_in_face() {
    ++steps_;
    p_.update_ghosts();
    scaled_.apply(p_, Ap_);
    const double pAp = algebra::dot(p_, Ap_), slope = algebra::dot(gradient_, p_);
    const double feasible = contact::largest_feasible_step(scaled_.lower(), scaled_.upper(), x_, p_);
    const double step = pAp > no_stiffness * algebra::dot(p_, p_) ? slope / pAp : infinity;
    if (step == infinity && feasible == infinity) {
      outcome_ = Status::not_held;
    } else if (step <= feasible) {
      algebra::axpy(-step, p_, x_);
      algebra::axpy(-step, Ap_, gradient_);
      look_around();
      const double beta = algebra::dot(z_, Ap_) / pAp;
      for (std::size_t i = 0; i < p_.owned().size(); ++i) p_.owned()[i] = z_.owned()[i] - beta * p_.owned()[i];
      p_.update_ghosts();
    } else {
      expand(step, feasible, -feasible * slope + 0.5 * feasible * feasible * pAp);
    }
  }

  // Takes the projected conjugate-gradient step where it lowers the energy more than the feasible half-step. Otherwise
  // takes the half-step and a projected step along the free gradient.
  void expand(double step, double feasible, double change_of_half_step) {
    if (std::isfinite(step)) {
      Vector candidate = contact::clamped_step(scaled_.lower(), scaled_.upper(), x_, p_, step);
      if (energy_change(candidate) < change_of_half_step) {
        x_ = std::move(candidate);
        return restart();
      }
    }
    x_ = contact::clamped_step(scaled_.lower(), scaled_.upper(), x_, p_, feasible);
    restart();
    for (;; step_length_ /= 2) {
      Vector candidate = contact::clamped_step(scaled_.lower(), scaled_.upper(), x_, split_.free, step_length_);
      // The estimate of |A| is a lower bound. A step that does not lower the energy shows that it is too small.
      if (!(energy_change(candidate) > 0) || step_length_ < epsilon) {
        x_ = std::move(candidate);
        return restart();
      }
    }
  }

  /// Returns g's + s'As/2 of the step s to `candidate`.
  double energy_change(const Vector& candidate) {
    s_ = candidate;
    algebra::axpy(-1, x_, s_);
    s_.update_ghosts();
    scaled_.apply(s_, As_);
    return algebra::dot(gradient_, s_) + 0.5 * algebra::dot(s_, As_);
  }

  // Proportioning: goes to the minimiser along the chopped gradient, at most to the next bound.
  void let_go(const Vector& d) {
    Vector direction = d, Ad(d.layout(), d.block());
    direction.update_ghosts();
    scaled_.apply(direction, Ad);
    const double dAd = algebra::dot(direction, Ad), slope = algebra::dot(gradient_, direction);
    const double feasible = contact::largest_feasible_step(scaled_.lower(), scaled_.upper(), x_, direction);
    const double step = dAd > no_stiffness * algebra::dot(direction, direction) ? slope / dAd : infinity;
    if (std::min(step, feasible) == infinity) {
      outcome_ = Status::not_held;
      return;
    }
    x_ = contact::clamped_step(scaled_.lower(), scaled_.upper(), x_, direction, std::min(step, feasible));
    restart();
    halved_ = infinity;
    since_halved_ = 0;
    record_face();
  }

  void record_face() {
    const Vector z = scaled_.original(x_);
    const Vector force = scaled_.original_forces(gradient_);
    const ActiveSet now = contact::everything_at_bounds(problem_, z);
    solution_.iterations.push_back({.active = contact::count_active(problem_, now),
                                    .changes = contact::count_changes(problem_, set_, now),
                                    .energy = 0.5 * (algebra::dot(z, force) - algebra::dot(z, problem_.load)),
                                    .linear_steps = steps_});
    solution_.z = z;
    solution_.multiplier = force;
    solution_.activity = set_ = now;
    steps_ = 0;
    if (observer_.iteration) observer_.iteration(solution_.iterations.back());
    check_limits();
  }

  void check_limits() {
    if (outcome_) return;
    if (static_cast<int>(solution_.iterations.size()) >= settings_.max_iterations)
      outcome_ = Status::iteration_limit;
    else if (observer_.wants_to_stop())
      outcome_ = Status::interrupted;
  }

  // Computes the minimiser on this face to full accuracy, through problem.apply, and judges it as in the other solvers.
  void conclude() {
    Vector z = scaled_.original(x_);
    const ActiveSet set = contact::everything_at_bounds(problem_, z);
    const auto precondition = [this](const Vector& r, Vector& to) { preconditioner_.apply(r, to); };
    const auto linear = algebra::conjugate_gradients(
        problem_.apply, precondition, problem_.load, contact::fixed_by(set), diagonal_, z,
        {.tolerance = settings_.linear_tolerance, .max_steps = most_steps, .patience = patience});
    constexpr double usable = 1e-6;
    if (!linear.converged && !(linear.relative_residual <= usable)) {
      outcome_ = std::isfinite(linear.relative_residual) ? Status::linear_solver_stalled : Status::not_finite;
      return;
    }
    contact::SubproblemPoint point = contact::assess(problem_, settings_, diagonal_, std::move(z), linear, set);
    point.linear_steps += steps_;
    const contact::Verdict verdict = contact::judge(problem_, point, set);
    const bool seen_before = !concluded_.insert(contact::fingerprint(problem_, set)).second;
    const std::int64_t changes = contact::record(problem_, std::move(point), set, verdict, observer_, solution_);
    steps_ = 0;
    if (changes == 0) outcome_ = Status::solved;
    check_limits();
    if (!outcome_ && seen_before) outcome_ = Status::cycling;
    if (!outcome_) go_on_from(verdict);
  }

  // Restarts from the face's minimiser, projected on the box; only the unknowns that judge() releases become free.
  void go_on_from(const contact::Verdict& verdict) {
    set_ = solution_.activity;
    x_ = scaled_.unknowns(contact::project(problem_, solution_.z));
    restart();
    halved_ = infinity;
    since_halved_ = 0;
    Vector released(x_.layout(), x_.block());
    for (std::size_t i = 0; i < set_.size(); ++i)
      if (set_[i] != Activity::free && verdict.next[i] == Activity::free)
        released.owned()[i] = split_.chopped.owned()[i];
    if (algebra::max_abs(released) > 0) let_go(released);
  }

  const BoxProblem& problem_;
  const ScaledUnknowns& scaled_;
  const FacePreconditioner& preconditioner_;
  const Vector& diagonal_;
  const Settings& settings_;
  const Observer& observer_;
  BoxSolution& solution_;
  Vector x_, gradient_, z_, p_{};
  Vector Ap_, s_, As_, force_, original_;  ///< scratch vectors of every step
  SplitGradient split_{};
  double phi_z_ = 0, reference_ = 0, step_length_ = 0;
  double halved_ = infinity;  ///< preconditioned norm of the free gradient at its last halving
  int since_halved_ = 0;
  int steps_ = 0;  ///< since the last iteration
  ActiveSet set_;  ///< active set of the last iteration
  std::set<std::uint64_t> concluded_{};
  std::optional<Status> outcome_{};
};

/// Computes the minimiser on the fixed set by conjugate gradients.
algebra::CgResult first_minimiser(const BoxProblem& problem, const FacePreconditioner& preconditioner,
                                  const ActiveSet& set, const Vector& diagonal, Vector& z) {
  for (std::size_t i = 0; i < set.size(); ++i)
    if (set[i] != Activity::free) z.owned()[i] = contact::bound_at(problem, i, set[i]);
  constexpr double rough = 1e-8;
  const auto precondition = [&](const Vector& r, Vector& to) { preconditioner.apply(r, to); };
  return algebra::conjugate_gradients(problem.apply, precondition, problem.load, contact::fixed_by(set), diagonal, z,
                                      {.tolerance = rough, .max_steps = most_steps, .patience = patience});
}

}  // namespace

BoxSolution solve_mprgp(const BoxProblem& problem, std::span<const Activity> initial,
                        algebra::Preconditioner& preconditioner, const Settings& settings, const Observer& observer) {
  if (!problem.pressing.empty())
    return contact::solve_by_pressing_search(problem, initial, preconditioner, settings, observer, solve_mprgp);
  if (problem.equations)
    return contact::solve_by_dual_ascent(problem, initial, preconditioner, settings, observer, solve_mprgp);
  BoxSolution solution = contact::unsolved(problem, Status::infeasible);
  if (!contact::bounds_are_consistent(problem)) return solution;
  const Vector diagonal = positive_diagonal(problem);
  FacePreconditioner on_faces(preconditioner, diagonal);
  ActiveSet set = contact::starting_set(problem, initial);
  solution.status = Status::singular;
  if (!on_faces.fix(problem, set, settings.detect_free_motions)) {
    set = contact::everything_active(problem);
    if (!on_faces.fix(problem, set, settings.detect_free_motions)) return solution;
  }
  const auto linear = first_minimiser(problem, on_faces, set, diagonal, solution.z);
  solution.z = contact::project(problem, std::move(solution.z));
  if (!std::isfinite(linear.relative_residual)) {
    solution.status = Status::not_finite;
    return solution;
  }
  const ScaledUnknowns scaled(problem);
  solution.status = Mprgp(problem, scaled, on_faces, diagonal, settings, observer, solution).run();
  return solution;
}

}  // namespace plastron::referees

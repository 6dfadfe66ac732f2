// PETSc's bounded Newton method as a contact solver:
//   1. The minimiser on the subproblem of the initial set (with all bounds active if that set has none), projected on
//      the box.
//   2. PETSc's method starts there in the unknowns of ScaledUnknowns. Its matrix has a unit diagonal, so PETSc's norms
//      and tolerances do not depend on units of length or force. Its linear systems are solved with our preconditioner
//      and conjugate gradients through problem.apply. PETSc chooses sets, steps and line searches.
//   3. One polish: the subproblem of PETSc's last active set, solved and judged as in the other solvers. The reason:
//      PETSc stops at a residual of 1e-8, and the certificate requires rounding accuracy. If nothing changes, this is
//      the solution.
//   4. Otherwise (PETSc failed, or decided a tie differently) the projected search continues from PETSc's last point.
//      Its iterations are marked `safeguarded`.
#include <plastron/contact/pressing.hpp>
#include <plastron/contact/searches.hpp>
#include <research/referees/bounded_newton.hpp>
#include <research/referees/faces.hpp>
#include <research/referees/solvers.hpp>

#include <algorithm>
#include <vector>

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
using contact::SubproblemSolver;

/// One run of PETSc's method, and its iterates as iterations of the solution.
class TaoRun {
 public:
  TaoRun(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings,
         const Observer& observer, BoxSolution& solution)
      : problem_(problem),
        scaled_(problem),
        preconditioner_(preconditioner),
        settings_(settings),
        observer_(observer),
        solution_(solution),
        diagonal_(problem.matrix.diagonal()),
        set_(contact::everything_at_bounds(problem, solution.z)) {}

  BoundedNewtonEnd run() {
    const BoundedQuadratic quadratic{.apply = [this](const Vector& x, Vector& y) { scaled_.apply(x, y); },
                                     .load = scaled_.load(),
                                     .lower = scaled_.lower(),
                                     .upper = scaled_.upper(),
                                     .solve_on_face = [this](std::span<const char> fixed, const Vector& r,
                                                             Vector& s) { return solve_on_face(fixed, r, s); }};
    const BoundedNewtonSettings settings{.max_iterations = std::max(0, settings_.max_iterations - 1),
                                         .go_on = [this](int iteration, const Vector& x, const Vector& gradient) {
                                           return follow(iteration, x, gradient);
                                         }};
    Vector x = scaled_.unknowns(solution_.z);
    const BoundedNewtonEnd end = minimise_with_tao(quadratic, settings, x);
    solution_.z = contact::project(problem_, scaled_.original(x));
    return end;
  }

 private:
  /// PETSc's faces, with prescribed unknowns fixed in any case.
  bool solve_on_face(std::span<const char> fixed_by_petsc, const Vector& r, Vector& s) {
    constexpr double usable_residual = 1e-6;
    std::vector<char> fixed = contact::fixed_by(contact::starting_set(problem_, {}));
    Vector force = scaled_.original_forces(r), increment(s.layout(), s.block());
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      if (fixed_by_petsc[i]) fixed[i] = 1;
      if (fixed[i]) force.owned()[i] = 0;
    }
    if (!prepare(fixed)) return false;
    const auto precondition = [this](const Vector& from, Vector& to) { preconditioner_.apply(from, to); };
    const auto linear = algebra::conjugate_gradients(
        problem_.apply, precondition, force, fixed, diagonal_, increment,
        {.tolerance = settings_.linear_tolerance, .max_steps = settings_.max_refinement_steps});
    if (!linear.converged && !(linear.relative_residual <= usable_residual)) return false;
    s = scaled_.unknowns(increment);
    return true;
  }

  /// Makes the preconditioner ready for a face. Returns false if the face leaves a motion free.
  bool prepare(const std::vector<char>& fixed) {
    const auto differs = static_cast<std::int64_t>(fixed != fixed_);
    if (algebra::sum_over_ranks(differs, problem_.load.layout()->comm) == 0) return is_ready_;
    fixed_ = fixed;
    is_ready_ =
        preconditioner_.fix(fixed, problem_.shift) &&
        !(settings_.detect_free_motions && preconditioner_.softest_motion(problem_.apply, fixed, diagonal_).is_free());
    return is_ready_;
  }

  // The start is not an iteration.
  bool follow(int iteration, const Vector& x, const Vector& gradient) {
    if (iteration == 0) return true;
    const ActiveSet set = contact::everything_at_bounds(problem_, contact::project(problem_, scaled_.original(x)));
    const Vector z = scaled_.original(x), force = scaled_.original_forces(gradient);
    solution_.iterations.push_back({.active = contact::count_active(problem_, set),
                                    .changes = contact::count_changes(problem_, set_, set),
                                    .energy = 0.5 * (algebra::dot(z, force) - algebra::dot(z, problem_.load))});
    set_ = set;
    if (observer_.iteration) observer_.iteration(solution_.iterations.back());
    return !observer_.wants_to_stop();
  }

  const BoxProblem& problem_;
  ScaledUnknowns scaled_;
  algebra::Preconditioner& preconditioner_;
  const Settings& settings_;
  const Observer& observer_;
  BoxSolution& solution_;
  Vector diagonal_;
  ActiveSet set_;              ///< active set of the previous iterate
  std::vector<char> fixed_{};  ///< the unknowns that the preconditioner fixes; empty at first
  bool is_ready_ = false;
};

/// Step 3. Returns whether the solution has ended.
bool polish(const BoxProblem& problem, SubproblemSolver& subproblems, const Observer& observer, BoxSolution& solution) {
  const ActiveSet set = contact::everything_at_bounds(problem, solution.z);
  auto point = subproblems.solve(set);
  if (!point) return false;
  const contact::Verdict verdict = contact::judge(problem, *point, set);
  return contact::record(problem, std::move(*point), set, verdict, observer, solution) == 0;
}

/// Solves a problem without equations and pressing forces.
BoxSolution solve_box(const BoxProblem& problem, std::span<const Activity> initial,
                      algebra::Preconditioner& preconditioner, const Settings& settings, const Observer& observer) {
  BoxSolution solution = contact::unsolved(problem, Status::infeasible);
  if (!contact::bounds_are_consistent(problem)) return solution;
  SubproblemSolver first(problem, preconditioner, settings);
  auto start = first.solve_first(initial);
  solution.status = first.failure();
  if (!start) return solution;
  solution.z = contact::project(problem, std::move(start->z));
  const BoundedNewtonEnd end = TaoRun(problem, preconditioner, settings, observer, solution).run();
  solution.status = Status::interrupted;
  if (end == BoundedNewtonEnd::stopped) return solution;
  const Vector last = solution.z;
  SubproblemSolver subproblems(problem, preconditioner,
                               settings);  // `first` does not know the preconditioner's new set
  solution.status = Status::solved;
  if (polish(problem, subproblems, observer, solution)) return solution;
  solution.status = Status::iteration_limit;
  if (static_cast<int>(solution.iterations.size()) >= settings.max_iterations) return solution;
  solution.z = last;
  contact::continue_on_box(problem, subproblems, settings, observer, solution);
  return solution;
}

}  // namespace

BoxSolution solve_tao(const BoxProblem& problem, std::span<const Activity> initial,
                      algebra::Preconditioner& preconditioner, const Settings& settings, const Observer& observer) {
  if (!problem.pressing.empty())
    return contact::solve_by_pressing_search(problem, initial, preconditioner, settings, observer, solve_tao);
  if (problem.equations)
    return contact::solve_by_dual_ascent(problem, initial, preconditioner, settings, observer, solve_tao);
  return solve_box(problem, initial, preconditioner, settings, observer);
}

}  // namespace plastron::referees

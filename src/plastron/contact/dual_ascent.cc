// Equations B z = 0 beside the bounds, for solvers of boxes only. This method is also the safeguard of the primal-dual
// method with equations. A projection onto the box violates the equations, so they get multipliers q first:
//   d(q) = min { 1/2 z' A z - (b - B' q)' z : lower <= z <= upper }
// is a program with a box alone, for any contact solver. d is concave, and d'(q) = B z(q) with z(q) the minimiser. At
// the maximum of d, z(q) solves the whole problem. d is quadratic while the active set S of z(q) stays. Its maximiser
// there is the multiplier of the subproblem A z + B' q = b, B z = 0 on S:
//   1. z(q) and its active set S by the contact solver.
//   2. q* of the subproblem on S. If its z satisfies all bounds and signs, it is the solution.
//   3. q := q + t (q* - q) with the first t of 1, 1/2, ... for which d increases by a fraction of its slope, then step
//      1. Where the equations cannot be satisfied on S, the direction is P r instead. P is the preconditioner of (B
//      A^{-1} B')^{-1}. r is the part of d'(q) that remains for every q on S. d is nearly linear along it, so t may
//      also double.
// This is Newton's method for a piecewise quadratic concave function, with d as safeguard: d increases at every step.
// Sources: Qi and Sun, A nonsmooth version of Newton's method (1993), for the steps; Bertsekas, Constrained
// optimization and Lagrange multiplier methods (1982), section 5.3, for the dual function.
#include <plastron/contact/outer_search.hpp>
#include <plastron/contact/pressing.hpp>

#include <cmath>
#include <optional>

namespace plastron::contact {
namespace {

using algebra::Vector;

/// The value d(q) and the data from which it is computed.
struct DualPoint {
  Vector q{};
  Vector violation{};  ///< d'(q) = B z
  double value = 0;
  ActiveSet set{};
};

class DualAscent : OuterSearch {
 public:
  using OuterSearch::OuterSearch;

  void run() {
    Vector q = solution_.equation_multiplier.layout() ? solution_.equation_multiplier : problem_.equations->multipliers;
    std::optional<DualPoint> here = evaluate(std::move(q), solution_.activity);
    while (here) {
      SubproblemSolver subproblems(problem_, preconditioner_, settings_);
      const std::optional<Vector> best = maximise_on(subproblems, here->set, here->q);
      if (has_ended_) return;
      Vector direction = best ? *best : ascent(subproblems, *here);
      if (best) algebra::axpy(-1, here->q, direction);
      here = climb(*here, direction, best.has_value());
    }
  }

 private:
  // Nothing if the inner solver fails or reaches the limit; then the solution has its status.
  std::optional<DualPoint> evaluate(Vector q, const ActiveSet& start) {
    const auto settings = settings_left();
    if (!settings) return {};
    const EqualityConstraints& equations = *problem_.equations;
    BoxProblem box{.matrix = problem_.matrix,
                   .apply = problem_.apply,
                   .load = problem_.load,
                   .lower = problem_.lower,
                   .upper = problem_.upper};
    q.update_ghosts();
    Vector force(box.load.layout(), box.load.block());
    equations.apply_transposed(q, force);
    algebra::axpy(-1, force, box.load);
    const Observer inside{.iteration = [this](const Iteration& i) { count(i); }, .stop = observer_.stop};
    BoxSolution inner = box_solver_(box, start, preconditioner_, *settings, inside);
    if (inner.status != Status::solved) return no_more(inner.status);
    DualPoint point{.q = std::move(q), .violation = equations.multipliers, .set = std::move(inner.activity)};
    inner.z.update_ghosts();
    equations.apply(inner.z, point.violation);
    point.value = inner.iterations.empty() ? 0 : inner.iterations.back().energy;
    return point;
  }

  /// Step 2: returns q*, or ends with the solution. Nothing where the equations cannot be satisfied on the set, or at
  /// an end.
  std::optional<Vector> maximise_on(SubproblemSolver& subproblems, const ActiveSet& set, const Vector& q) {
    subproblems.start_multipliers_from(q);
    auto point = subproblems.solve(set);
    if (!point) return {};
    Vector best = point->equation_multiplier;
    const Verdict verdict = judge(problem_, *point, set);
    if (store(std::move(*point), set, verdict) == 0) end(Status::solved);
    return best;
  }

  Vector preconditioned(const Vector& violation) const {
    Vector direction = problem_.equations->multipliers;
    problem_.equations->precondition(violation, direction);
    return direction;
  }

  /// Returns the ascent direction. It uses the part of d' that cannot be reduced on the set, if there is one. Along
  /// this part d is nearly linear while the set stays. This permits a long step, where the other part permits a short
  /// one. If the violation can be reduced entirely, only rounding remains of this part, and it is useless.
  Vector ascent(const SubproblemSolver& subproblems, const DualPoint& here) const {
    constexpr double rounding = 1e-10;  // relative to the whole slope
    Vector whole = preconditioned(here.violation);
    if (subproblems.failure() != Status::linear_solver_stalled) return whole;  // not even A is definite
    Vector rest = preconditioned(subproblems.irreducible(here.set, here.violation));
    return algebra::dot(rest, here.violation) > rounding * algebra::dot(whole, here.violation) ? rest : whole;
  }

  std::optional<DualPoint> climb(const DualPoint& here, const Vector& direction, bool is_newtons) {
    const double slope = algebra::dot(direction, here.violation);
    if (!(slope > 0)) return no_more(std::isfinite(slope) ? Status::cycling : Status::not_finite);
    auto next = first_rise(here, direction, slope);
    if (next && !is_newtons) next = lengthened(here, direction, slope, std::move(*next));
    return next;
  }

  std::optional<DualPoint> step(const DualPoint& here, const Vector& direction, double t) {
    Vector q = here.q;
    algebra::axpy(t, direction, q);
    return evaluate(std::move(q), here.set);
  }

  // Armijo's test on d. Where the values of d agree up to rounding, a slope that is still not negative proves the
  // increase.
  std::optional<DualPoint> first_rise(const DualPoint& here, const Vector& direction, double slope) {
    constexpr double fraction_of_slope = 1e-4;
    constexpr int most_halvings = 40;
    double t = 1;
    for (int halvings = 0; halvings < most_halvings; ++halvings, t /= 2) {
      auto next = step(here, direction, t);
      if (!next) return {};
      const bool still_rises = algebra::dot(direction, next->violation) >= 0;
      if (still_rises || next->value - here.value >= fraction_of_slope * t * slope) {
        length_ = t;
        return next;
      }
    }
    return no_more(Status::cycling);
  }

  // The direction has no natural length: the step is doubled until the slope has halved.
  std::optional<DualPoint> lengthened(const DualPoint& here, const Vector& direction, double slope, DualPoint next) {
    constexpr int most_doublings = 30;
    for (int k = 0; k < most_doublings; ++k) {
      if (!(algebra::dot(direction, next.violation) > 0.5 * slope)) return next;
      length_ *= 2;
      auto further = step(here, direction, length_);
      if (!further) return {};
      if (!(further->value > next.value)) return next;
      next = std::move(*further);
    }
    return no_more(Status::infeasible);  // d has no maximum
  }
};

}  // namespace

BoxSolution solve_by_dual_ascent(const BoxProblem& problem, std::span<const Activity> initial,
                                 algebra::Preconditioner& preconditioner, const Settings& settings,
                                 const Observer& observer, SolverFunction& box_solver) {
  BoxSolution solution = unsolved(problem, Status::infeasible);
  solution.equation_multiplier = problem.equations->multipliers;
  if (!bounds_are_consistent(problem)) return solution;
  solution.activity = starting_set(problem, initial);
  DualAscent(problem, preconditioner, settings, observer, box_solver, false, solution).run();
  return solution;
}

void continue_dual_ascent(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings,
                          const Observer& observer, SolverFunction& box_solver, BoxSolution& so_far) {
  DualAscent(problem, preconditioner, settings, observer, box_solver, true, so_far).run();
}

}  // namespace plastron::contact

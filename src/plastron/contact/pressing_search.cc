// Pressing forces for solvers of fixed bounds only. This method is also the safeguard of the primal-dual method with
// pressing forces. The positions get a problem of their own: the function
//   phi(delta) = min { 1/2 z' A z - b' z : lower(delta) <= z <= upper(delta) } - F' delta
// is convex and piecewise quadratic. Each value is a program for any contact solver. Its gradient is R(delta) - F, the
// reactions minus the forces. On the pieces where the active set S stays, its Hessian is the border's z_k' A z_l
// (pressed_subproblem.hpp):
//   1. z(delta) and its active set S by the contact solver, started on the last S. A force that S does not carry moves
//      until it touches. phi decreases on the way, and z does not change.
//   2. delta* of the subproblem of S with its border. If its z satisfies all bounds and signs, it is the solution.
//   3. delta := delta + t (delta* - delta) with the first t of 1, 1/2, ... for which phi decreases, then step 1. The
//      criterion: the slope is still not positive, or phi is lower by a fraction of the slope. Where bounds would cross
//      on the way, delta* is the minimiser of S that leaves a tenth of their width. Where the border is singular on S,
//      the direction is the free motion, if the forces drive it, or F - R over a scale. Then t doubles while the slope
//      stays.
// This is Newton's method for a piecewise quadratic convex function, with phi as safeguard: phi decreases at every
// step. The proof is in docs/methods/pressing-obstacles.md. Source: Sun, On the structure of convex piecewise quadratic
// functions (1992); Qi and Sun, A nonsmooth version of Newton's method (1993).
#include <plastron/contact/outer_search.hpp>
#include <plastron/contact/pressed_subproblem.hpp>
#include <plastron/contact/pressing.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace plastron::contact {
namespace {

using algebra::Vector;
using Positions = std::vector<double>;

/// The value phi(delta) and the data from which it is computed.
struct PressedState {
  Positions positions{};
  Positions excess{};  ///< F - R = - phi'
  double value = 0;
  ActiveSet set{};
  BoxSolution inner{};
};

/// Part of the width between two bounds that a step may remove, and number of such steps in a row that shows that no
/// minimum lies between.
constexpr double part_of_the_way = 0.9;
constexpr int most_in_a_row = 8;

struct Direction {
  Positions by{};
  bool is_newtons = true;
};

Positions moved(const Positions& from, double t, const Positions& direction) {
  Positions to = from;
  for (std::size_t k = 0; k < to.size(); ++k) to[k] += t * direction[k];
  return to;
}

double slope_along(const Positions& direction, const Positions& excess) {
  double slope = 0;
  for (std::size_t k = 0; k < direction.size(); ++k) slope -= direction[k] * excess[k];
  return slope;
}

/// Whether other positions may help after this status of the inner solver.
bool is_about_the_positions(Status status) {
  return status != Status::iteration_limit && status != Status::interrupted;
}

/// Returns F - R, each divided by the stiffness that A's diagonal gives the unknowns that carry the force.
Positions scaled_excess(const BoxProblem& problem, const PressedState& here, const Vector& diagonal) {
  Positions direction = here.excess;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    const Vector shape = active_shape(problem.pressing[k], here.set);
    Vector forces = shape;
    for (std::size_t i = 0; i < forces.owned().size(); ++i) forces.owned()[i] *= diagonal.owned()[i];
    const double scale = algebra::dot(shape, forces);
    direction[k] = scale > 0 ? direction[k] / scale : 0;
  }
  return direction;
}

/// Returns the free motion on the set, whose stiffness is only rounding, with the length of `ascent`. Nothing if the
/// forces hardly drive it, or if it does not belong to them.
std::optional<Positions> along_free_motion(const Positions& excess, const Positions& motion, const Positions& ascent) {
  constexpr double hardly = 1e-8;
  if (motion.size() != excess.size()) return {};
  const auto size = [](const Positions& v) { return std::sqrt(std::max(0.0, -slope_along(v, v))); };
  const double drive = -slope_along(motion, excess);
  if (!(std::abs(drive) > hardly * size(motion) * size(excess))) return {};
  return moved(Positions(motion.size(), 0.0), (drive > 0 ? 1 : -1) * size(ascent) / size(motion), motion);
}

class PressingSearch : OuterSearch {
 public:
  using OuterSearch::OuterSearch;

  /// Call it before run(), unless the solution already has positions and an active set.
  void start(std::span<const Activity> initial) {
    ActiveSet set;
    auto point = subproblem_.solve_first(initial, set);
    if (!point) return end(subproblem_.failure());
    solution_.activity = take(std::move(*point), set).next;
  }

  void run() {
    if (has_ended_) return;
    std::optional<PressedState> here = begin();
    while (here) {
      touch_all(*here);
      const auto direction = towards_minimum(*here);
      if (!direction) return;
      here = descend(*here, *direction);
    }
  }

 private:
  /// Stores a subproblem's point as the solution so far. The search ends if the point satisfies all conditions.
  Verdict take(SubproblemPoint point, const ActiveSet& set) {
    Verdict verdict = judge(subproblem_.box(), point, set);
    const bool crossed = bounds_cross(subproblem_.box(), point.gap_noise);
    if (store(std::move(point), set, verdict) == 0 && !crossed) end(Status::solved);
    return verdict;
  }

  // If the inner solver finds nothing at the first positions, tries the positions at which the bounds were given.
  std::optional<PressedState> begin() {
    auto here = evaluate(solution_.positions, solution_.activity);
    const Status failure = solution_.status;
    if (!here && !has_ended_) here = evaluate(Positions(problem_.pressing.size(), 0.0), solution_.activity);
    if (!here && !has_ended_) end(failure);
    return here;
  }

  // Nothing where the inner solver fails; then the solution has its status. The search has then ended if no other
  // positions help.
  std::optional<PressedState> evaluate(Positions positions, const ActiveSet& start) {
    const auto settings = settings_left();
    if (!settings) return {};
    const double work = work_of_forces(problem_, positions);
    const Observer inside{.iteration =
                              [&](Iteration iteration) {
                                iteration.energy -= work;
                                count(iteration);
                              },
                          .stop = observer_.stop};
    BoxSolution inner = box_solver_(at_positions(problem_, positions), start, preconditioner_, *settings, inside);
    solution_.status = inner.status;
    if (inner.status != Status::solved) {
      if (!is_about_the_positions(inner.status)) has_ended_ = true;
      return {};
    }
    PressedState state{.positions = std::move(positions), .set = starting_set(problem_, inner.activity)};
    state.excess = reactions(problem_, inner.multiplier, state.set);
    for (std::size_t k = 0; k < state.excess.size(); ++k)
      state.excess[k] = problem_.pressing[k].force - state.excess[k];
    state.value = inner.iterations.empty() ? -work : inner.iterations.back().energy - work;
    state.inner = std::move(inner);
    return state;
  }

  /// Step 1: makes touched unknowns active.
  void touch_all(PressedState& here) const {
    const BoxProblem box = at_positions(problem_, here.positions);
    double largest = 0;
    for (std::size_t i = 0; i < here.set.size(); ++i)
      if (std::isfinite(box.lower.owned()[i]) || std::isfinite(box.upper.owned()[i]))
        largest = std::max(largest, std::abs(here.inner.z.owned()[i]));
    largest = algebra::max_over_ranks(largest, problem_.load.layout()->comm);
    const double noise = here.inner.tolerances.gap * largest;
    for (std::size_t k = 0; k < here.positions.size(); ++k)
      if (!is_carried(problem_.pressing[k], here.set))
        for (const Touch& touched : touch(
                 problem_, k, here.inner.z, [&](std::size_t) { return noise; }, here.positions))
          here.set[touched.unknown] = touched.activity;
  }

  /// Step 2. Returns nothing if the search ends.
  std::optional<Direction> towards_minimum(const PressedState& here) {
    subproblem_.start_from(here.positions);
    if (here.inner.equation_multiplier.layout())
      subproblem_.subproblems().start_multipliers_from(here.inner.equation_multiplier);
    auto point = subproblem_.solve(here.set);
    if (!point && subproblem_.failure() != Status::singular) return no_more(subproblem_.failure());
    if (!point) {
      const auto ascent = scaled_excess(problem_, here, subproblem_.subproblems().diagonal());
      const auto free = along_free_motion(here.excess, subproblem_.border().free_motion(), ascent);
      return Direction{.by = free.value_or(ascent), .is_newtons = false};
    }
    Direction direction{.by = moved(point->positions, -1, here.positions)};
    take(std::move(*point), here.set);
    if (has_ended_) return {};
    return direction;
  }

  /// Step 3.
  std::optional<PressedState> descend(const PressedState& here, Direction direction) {
    keep_bounds_apart(here, direction);
    const double slope = slope_along(direction.by, here.excess);
    if (stopped_in_a_row_ > most_in_a_row) return no_more(Status::infeasible);
    if (!std::isfinite(slope)) return no_more(Status::not_finite);
    if (!(slope < 0)) return no_more(stopped_in_a_row_ > 0 ? Status::infeasible : Status::cycling);
    length_ = 1;
    auto next = first_fall(here, direction.by, slope);
    if (next && !direction.is_newtons) next = lengthened(here, direction.by, slope, std::move(*next));
    return next;
  }

  /// Changes the direction where bounds would cross on the way. It then leads to the minimiser of the border's
  /// quadratic function with a tenth of the bounds' present width. This is also a descent direction. After too many
  /// such steps in a row, phi is least where the bounds meet.
  void keep_bounds_apart(const PressedState& here, Direction& direction) {
    const Positions newtons = direction.by;
    std::vector<Positions> rows;
    Positions values;
    while (const auto wedge = first_wedge(problem_, here.positions, direction.by)) {
      rows.push_back(wedge->closing);
      values.push_back(part_of_the_way * wedge->width);
      const auto nearest = direction.is_newtons && rows.size() <= newtons.size()
                               ? subproblem_.border().nearest(newtons, rows, values)
                               : std::nullopt;
      if (!nearest || std::ranges::any_of(nearest->multipliers, [](double mu) { return mu < 0; })) {
        direction.by = shortened(here, newtons);
        break;
      }
      direction.by = nearest->x;
    }
    stopped_in_a_row_ = rows.empty() ? 0 : stopped_in_a_row_ + 1;
  }

  Positions shortened(const PressedState& here, Positions direction) const {
    const auto wedge = first_wedge(problem_, here.positions, direction);
    if (!wedge) return direction;
    const double speed = -slope_along(direction, wedge->closing);
    for (double& by : direction) by *= part_of_the_way * wedge->width / speed;
    return direction;
  }

  std::optional<PressedState> first_fall(const PressedState& here, const Positions& direction, double slope) {
    constexpr double fraction_of_slope = 1e-4;
    constexpr int most_halvings = 50;
    Status failure = Status::cycling;
    for (int halvings = 0; halvings < most_halvings; ++halvings, length_ /= 2) {
      auto next = evaluate(moved(here.positions, length_, direction), here.set);
      if (has_ended_) return {};
      if (!next) {
        failure = solution_.status;
        continue;
      }
      const bool still_falls = slope_along(direction, next->excess) <= 0;
      if (still_falls || next->value - here.value <= fraction_of_slope * length_ * slope) return next;
      failure = Status::cycling;
    }
    return no_more(stopped_in_a_row_ > 0 ? Status::infeasible : failure);
  }

  // The direction has no natural length: the step is doubled until the slope has halved.
  std::optional<PressedState> lengthened(const PressedState& here, const Positions& direction, double slope,
                                         PressedState next) {
    constexpr int most_doublings = 40;
    for (int k = 0; k < most_doublings; ++k) {
      if (!(slope_along(direction, next.excess) < 0.5 * slope)) return next;
      length_ *= 2;
      if (first_wedge(problem_, here.positions, moved(Positions(direction.size(), 0.0), length_, direction)))
        return next;
      auto further = evaluate(moved(here.positions, length_, direction), next.set);
      if (has_ended_) return {};
      if (!further || !(slope_along(direction, further->excess) <= 0)) return next;
      next = std::move(*further);
    }
    return no_more(Status::not_carried);  // phi decreases without limit
  }

  PressedSubproblem subproblem_{problem_, preconditioner_, settings_};
  int stopped_in_a_row_ = 0;  ///< number of successive steps that crossing bounds have shortened
};

}  // namespace

BoxSolution solve_by_pressing_search(const BoxProblem& problem, std::span<const Activity> initial,
                                     algebra::Preconditioner& preconditioner, const Settings& settings,
                                     const Observer& observer, SolverFunction& box_solver) {
  BoxSolution solution = unsolved(problem, Status::infeasible);
  if (problem.equations) solution.equation_multiplier = problem.equations->multipliers;
  if (!bounds_are_consistent(problem)) return solution;
  solution.status = Status::not_carried;
  if (!every_force_can_be_carried(problem)) return solution;
  PressingSearch search(problem, preconditioner, settings, observer, box_solver, false, solution);
  search.start(initial);
  search.run();
  return solution;
}

void continue_pressing_search(const BoxProblem& problem, algebra::Preconditioner& preconditioner,
                              const Settings& settings, const Observer& observer, SolverFunction& box_solver,
                              BoxSolution& so_far) {
  PressingSearch(problem, preconditioner, settings, observer, box_solver, true, so_far).run();
}

}  // namespace plastron::contact

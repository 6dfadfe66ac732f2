#include <plastron/contact/newton_referee.hpp>
#include <plastron/contact/projected_search.hpp>
#include <plastron/contact/scaled_unknowns.hpp>
#include <plastron/contact/subproblem.hpp>

#include <algorithm>
#include <optional>

namespace plastron::contact {
namespace {

using algebra::BoundedNewtonEnd;
using algebra::Vector;

ActiveSet free_where_not_held(const BoxProblem& problem, std::span<const char> held) {
  ActiveSet set = starting_set(problem, {});
  for (std::size_t i = 0; i < set.size(); ++i)
    if (held[i] && set[i] != Activity::prescribed)
      set[i] = Activity::at_lower;  // an increment does not depend on which bound it is
  return set;
}

/// One run of PETSc's method, and its iterates as iterations of the solution.
class Run {
 public:
  Run(const BoxProblem& problem, SubproblemSolver& subproblems, const Observer& observer, BoxSolution& solution)
      : problem_(problem),
        scaled_(problem),
        subproblems_(subproblems),
        observer_(observer),
        solution_(solution),
        set_(everything_at_bounds(problem, solution.z)) {}

  BoundedNewtonEnd with(BoundedNewton& method, int max_iterations) {
    const algebra::BoundedQuadratic quadratic{.apply = [this](const Vector& x, Vector& y) { scaled_.apply(x, y); },
                                              .load = scaled_.load(),
                                              .lower = scaled_.lower(),
                                              .upper = scaled_.upper(),
                                              .solve_on_face = [this](std::span<const char> held, const Vector& r,
                                                                      Vector& s) { return solve_on_face(held, r, s); }};
    const algebra::BoundedNewtonSettings settings{
        .max_iterations = max_iterations, .go_on = [this](int iteration, const Vector& x, const Vector& gradient) {
          return follow(iteration, x, gradient);
        }};
    Vector x = scaled_.unknowns(solution_.z);
    const BoundedNewtonEnd end = method(quadratic, settings, x);
    solution_.z = project(problem_, scaled_.original(x));
    return end;
  }

 private:
  bool solve_on_face(std::span<const char> held, const Vector& r, Vector& s) {
    Vector increment(s.layout(), s.block()), force = scaled_.original_forces(r);
    const ActiveSet set = free_where_not_held(problem_, held);
    for (std::size_t i = 0; i < set.size(); ++i)
      if (set[i] != Activity::free) force.owned()[i] = 0;
    if (!subproblems_.solve_increment(set, force, increment)) return false;
    s = scaled_.unknowns(increment);
    return true;
  }

  // The start is not an iteration.
  bool follow(int iteration, const Vector& x, const Vector& gradient) {
    if (iteration == 0) return true;
    const ActiveSet set = everything_at_bounds(problem_, project(problem_, scaled_.original(x)));
    const Vector z = scaled_.original(x), force = scaled_.original_forces(gradient);
    solution_.iterations.push_back({.active = count_active(problem_, set),
                                    .changes = count_changes(problem_, set_, set),
                                    .energy = 0.5 * (algebra::dot(z, force) - algebra::dot(z, problem_.load))});
    set_ = set;
    if (observer_.iteration) observer_.iteration(solution_.iterations.back());
    return !observer_.wants_to_stop();
  }

  const BoxProblem& problem_;
  ScaledUnknowns scaled_;
  SubproblemSolver& subproblems_;
  const Observer& observer_;
  BoxSolution& solution_;
  ActiveSet set_;  ///< active set of the previous iterate
};

/// Step 3. Returns whether the solution has ended.
bool polish(const BoxProblem& problem, SubproblemSolver& subproblems, const Observer& observer, BoxSolution& solution) {
  const ActiveSet set = everything_at_bounds(problem, solution.z);
  auto point = subproblems.solve(set);
  if (!point) return false;
  const Verdict verdict = judge(problem, *point, set);
  return record(problem, std::move(*point), set, verdict, observer, solution) == 0;
}

}  // namespace

BoxSolution solve_by_bounded_newton(const BoxProblem& problem, std::span<const Activity> initial,
                                    algebra::Preconditioner& preconditioner, const Settings& settings,
                                    const Observer& observer, BoundedNewton& method) {
  BoxSolution solution = unsolved(problem, Status::infeasible);
  if (!bounds_are_consistent(problem)) return solution;
  SubproblemSolver subproblems(problem, preconditioner, settings);
  auto start = subproblems.solve_first(initial);
  solution.status = subproblems.failure();
  if (!start) return solution;
  solution.z = project(problem, std::move(start->z));
  const BoundedNewtonEnd end =
      Run(problem, subproblems, observer, solution).with(method, std::max(0, settings.max_iterations - 1));
  solution.status = Status::interrupted;
  if (end == BoundedNewtonEnd::stopped) return solution;
  const Vector last = solution.z;
  solution.status = Status::solved;
  if (polish(problem, subproblems, observer, solution)) return solution;
  solution.status = Status::iteration_limit;
  if (static_cast<int>(solution.iterations.size()) >= settings.max_iterations) return solution;
  solution.z = last;
  continue_projected_search(problem, subproblems, settings, observer, solution);
  return solution;
}

}  // namespace plastron::contact

#include <plastron/contact/active_set_steps.hpp>
#include <plastron/contact/pressing.hpp>
#include <plastron/contact/searches.hpp>
#include <plastron/contact/solve.hpp>

namespace plastron::contact {
namespace {

/// Whether proximal points can continue from a free motion. They treat neither equations nor pressing forces. A + rho D
/// has no free motion.
bool may_take_proximal_points(const BoxProblem& problem) {
  return problem.pressing.empty() && !problem.equations && problem.shift == 0 && !problem.may_be_indefinite;
}

/// Continues with a search that cannot cycle. Projections onto the box violate equations and the balance of pressing
/// forces.
void continue_safely(const BoxProblem& problem, PressedSubproblem& subproblems, algebra::Preconditioner& preconditioner,
                     const Settings& settings, const Observer& observer, BoxSolution& so_far) {
  if (!problem.pressing.empty())
    continue_pressing_search(problem, preconditioner, settings, observer, solve_primal_dual_active_set, so_far);
  else if (problem.equations)
    continue_dual_ascent(problem, preconditioner, settings, observer, solve_projected_search, so_far);
  else
    continue_on_box(problem, subproblems.subproblems(), settings, observer, so_far);
}

}  // namespace

BoxSolution solve_primal_dual_active_set(const BoxProblem& problem, std::span<const Activity> initial,
                                         algebra::Preconditioner& preconditioner, const Settings& asked,
                                         const Observer& observer) {
  Settings settings = asked;
  if (problem.equations && !problem.pressing.empty())
    return solve_by_pressing_search(problem, initial, preconditioner, settings, observer, solve_primal_dual_active_set);
  BoxSolution solution = unsolved(problem, Status::iteration_limit);
  if (!bounds_are_consistent(problem)) return unsolved(problem, Status::infeasible);
  if (!every_force_can_be_carried(problem)) return unsolved(problem, Status::not_carried);
  PressedSubproblem subproblems(problem, preconditioner, settings);  // refers to the settings, which change below
  const bool proximal = may_take_proximal_points(problem);
  ActiveSet set = starting_set(problem, initial);
  auto first = proximal ? subproblems.solve(set) : subproblems.solve_first(initial, set);
  if (first && problem.pressing.empty() && count_active(problem, set) == 0) {
    settings.detect_free_motions = false;  // more active bounds still fix the structure
    first = start_among_fewer(problem, subproblems, std::move(*first), observer, set, solution);
  }
  const StepsEnd end = iterate_active_sets(problem, subproblems, std::move(first), settings, observer, set, solution);
  if (end == StepsEnd::ended) return solution;
  if (end == StepsEnd::no_minimiser && subproblems.failure() == Status::singular && proximal) {
    solution.activity = set;
    continue_proximal_points(problem, subproblems.subproblems(), settings, observer, solve_primal_dual_active_set,
                             solution);
  } else if (solution.iterations.empty())
    solution.status = subproblems.failure();
  else if (end == StepsEnd::no_minimiser && problem.may_be_indefinite)
    solution.status = after_a_first_step(subproblems.failure());
  else
    continue_safely(problem, subproblems, preconditioner, settings, observer, solution);
  return solution;
}

void continue_on_box(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                     const Observer& observer, BoxSolution& so_far) {
  continue_projected_search(problem, subproblems, settings, observer, so_far);
  if (so_far.status == Status::not_held && may_take_proximal_points(problem))
    continue_proximal_points(problem, subproblems, settings, observer, solve_primal_dual_active_set, so_far);
}

BoxSolution solve_projected_search(const BoxProblem& problem, std::span<const Activity> initial,
                                   algebra::Preconditioner& preconditioner, const Settings& settings,
                                   const Observer& observer) {
  if (!problem.pressing.empty())
    return solve_by_pressing_search(problem, initial, preconditioner, settings, observer, solve_projected_search);
  if (problem.equations)
    return solve_by_dual_ascent(problem, initial, preconditioner, settings, observer, solve_projected_search);
  BoxSolution solution = unsolved(problem, Status::infeasible);
  if (!bounds_are_consistent(problem)) return solution;
  SubproblemSolver subproblems(problem, preconditioner, settings);
  auto point = subproblems.solve_first(initial);
  solution.status = subproblems.failure();
  if (!point) return solution;
  solution.z = std::move(point->z);
  continue_on_box(problem, subproblems, settings, observer, solution);
  return solution;
}

/// Whether z = 0 meets the bounds and carries the load, which is zero.
bool is_at_rest(const BoxProblem& problem) {
  double most = algebra::max_abs(problem.load);
  for (std::size_t i = 0; i < problem.load.owned().size(); ++i)
    most = std::max({most, problem.lower.owned()[i], -problem.upper.owned()[i]});
  return !problem.may_be_indefinite && problem.pressing.empty() &&
         algebra::max_over_ranks(most, problem.load.layout()->comm) <= 0;
}

SolverFunction& solver_of(const Settings& settings) {
  return settings.solver ? *settings.solver : solve_primal_dual_active_set;
}

BoxSolution solve(const BoxProblem& problem, std::span<const Activity> initial, algebra::Preconditioner& preconditioner,
                  const Settings& settings, const Observer& observer) {
  BoxSolution solution = solver_of(settings)(problem, initial, preconditioner, settings, observer);
  // An unloaded structure is at rest, also where motions are free.
  if (solution.status == Status::singular && is_at_rest(problem)) {
    std::vector<Iteration> iterations = std::move(solution.iterations);
    solution = unsolved(problem, Status::solved);
    solution.iterations = std::move(iterations);
  }
  return solution;
}

}  // namespace plastron::contact

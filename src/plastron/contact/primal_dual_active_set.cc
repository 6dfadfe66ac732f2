#include <plastron/contact/cold_start.hpp>
#include <plastron/contact/dual_ascent.hpp>
#include <plastron/contact/plain_active_set.hpp>
#include <plastron/contact/pressed_subproblem.hpp>
#include <plastron/contact/pressing.hpp>
#include <plastron/contact/pressing_search.hpp>
#include <plastron/contact/primal_dual_active_set.hpp>
#include <plastron/contact/projected_search.hpp>
#include <plastron/contact/proximal_point.hpp>

namespace plastron::contact {
namespace {

/// Whether proximal points can continue from a free motion. They treat neither equations nor pressing forces. A + rho D
/// has no free motion.
bool may_take_proximal_points(const BoxProblem& problem) {
  return problem.pressing.empty() && !problem.equations && problem.shift == 0;
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
    continue_projected_search(problem, subproblems.subproblems(), settings, observer, so_far);
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
  const PlainEnd end = iterate_active_sets(problem, subproblems, std::move(first), settings, observer, set, solution);
  if (end == PlainEnd::ended) return solution;
  if (end == PlainEnd::no_minimiser && subproblems.failure() == Status::singular && proximal) {
    solution.activity = set;
    continue_proximal_points(problem, subproblems.subproblems(), settings, observer, solution);
  } else if (solution.iterations.empty())
    solution.status = subproblems.failure();
  else
    continue_safely(problem, subproblems, preconditioner, settings, observer, solution);
  return solution;
}

}  // namespace plastron::contact

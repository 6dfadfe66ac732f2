#include <plastron/contact/dual_ascent.hpp>
#include <plastron/contact/pressed_subproblem.hpp>
#include <plastron/contact/pressing.hpp>
#include <plastron/contact/pressing_search.hpp>
#include <plastron/contact/primal_dual_active_set.hpp>
#include <plastron/contact/projected_search.hpp>

#include <algorithm>
#include <limits>
#include <set>

namespace plastron::contact {
namespace {

/// So many iterations without fewer changes than ever before end the plain method. Generous: from a cold start it
/// honestly moves the free boundary one element a step.
constexpr int patience_with_changes = 50;

// Whether the plain method still gets anywhere.
class Progress {
 public:
  bool is_lost(std::uint64_t next_set, std::int64_t changes) {
    const bool seen_before = !seen_.insert(next_set).second;
    since_fewer_changes_ = changes < fewest_changes_ ? 0 : since_fewer_changes_ + 1;
    fewest_changes_ = std::min(fewest_changes_, changes);
    return seen_before || since_fewer_changes_ > patience_with_changes;
  }

 private:
  std::set<std::uint64_t> seen_{};
  std::int64_t fewest_changes_ = std::numeric_limits<std::int64_t>::max();
  int since_fewer_changes_ = 0;
};

/// The searches that cannot cycle: projections onto the box keep neither equations nor the balance of pressing forces.
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
                                         algebra::Preconditioner& preconditioner, const Settings& settings,
                                         const Observer& observer) {
  if (problem.equations && !problem.pressing.empty())
    return solve_by_pressing_search(problem, initial, preconditioner, settings, observer, solve_primal_dual_active_set);
  BoxSolution solution = unsolved(problem, Status::iteration_limit);
  if (!bounds_are_consistent(problem)) return unsolved(problem, Status::infeasible);
  if (!every_force_can_be_carried(problem)) return unsolved(problem, Status::not_carried);
  PressedSubproblem subproblems(problem, preconditioner, settings);
  Progress progress;
  ActiveSet set;
  auto point = subproblems.solve_first(initial, set);
  progress.is_lost(fingerprint(problem, set), std::numeric_limits<std::int64_t>::max());
  while (point) {
    const Verdict verdict = judge(subproblems.box(), *point, set);
    const bool crossed = bounds_cross(subproblems.box(), point->gap_noise);
    const std::int64_t changes = record(problem, std::move(*point), set, verdict, observer, solution);
    if (changes == 0 && crossed) break;
    if (changes == 0) {
      solution.status = Status::solved;
      return solution;
    }
    if (static_cast<int>(solution.iterations.size()) >= settings.max_iterations) return solution;
    if (observer.wants_to_stop()) {
      solution.status = Status::interrupted;
      return solution;
    }
    if (progress.is_lost(fingerprint(problem, verdict.next), changes)) break;
    set = verdict.next;
    point = subproblems.solve(set);
  }
  if (solution.iterations.empty())
    solution.status = subproblems.failure();
  else
    continue_safely(problem, subproblems, preconditioner, settings, observer, solution);
  return solution;
}

}  // namespace plastron::contact

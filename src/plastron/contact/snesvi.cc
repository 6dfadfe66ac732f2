#include <plastron/algebra/bounded_newton.hpp>
#include <plastron/contact/dual_ascent.hpp>
#include <plastron/contact/newton_referee.hpp>
#include <plastron/contact/pressing_search.hpp>
#include <plastron/contact/snesvi.hpp>

namespace plastron::contact {

BoxSolution solve_snesvi(const BoxProblem& problem, std::span<const Activity> initial,
                         algebra::Preconditioner& preconditioner, const Settings& settings, const Observer& observer) {
  if (!problem.pressing.empty())
    return solve_by_pressing_search(problem, initial, preconditioner, settings, observer, solve_snesvi);
  if (problem.equations)
    return solve_by_dual_ascent(problem, initial, preconditioner, settings, observer, solve_snesvi);
  return solve_by_bounded_newton(problem, initial, preconditioner, settings, observer, algebra::solve_with_snesvi);
}

}  // namespace plastron::contact

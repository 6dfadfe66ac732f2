#include <plastron/contact/mprgp.hpp>
#include <plastron/contact/primal_dual_active_set.hpp>
#include <plastron/contact/projected_search.hpp>
#include <plastron/contact/snesvi.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/contact/tao.hpp>

namespace plastron::contact {

SolverFunction& function_of(Solver solver) {
  switch (solver) {
    case Solver::projected:
      return solve_projected_search;
    case Solver::tao:
      return solve_tao;
    case Solver::snesvi:
      return solve_snesvi;
    case Solver::mprgp:
      return solve_mprgp;
    case Solver::active_set:
      break;
  }
  return solve_primal_dual_active_set;
}

BoxSolution solve(const BoxProblem& problem, std::span<const Activity> initial, algebra::Preconditioner& preconditioner,
                  const Settings& settings, const Observer& observer) {
  return function_of(settings.solver)(problem, initial, preconditioner, settings, observer);
}

}  // namespace plastron::contact

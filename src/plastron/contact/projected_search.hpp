// The projected search: the safeguard of the primal-dual method, with a proof that it ends; also a solver of its own.
// It keeps a feasible z and lowers the energy E at each step:
//   1. Hold the unknowns at bounds; let z* minimise E on this subproblem.
//   2. If z* leaves the box, search along the projection P(z + t (z* - z)), t = 1, 1/2, ..., for the lowest energy that
//      is less than E(z) by a fraction of the slope; hold in addition what has come to a bound, and go to 1.
//   3. If z* is feasible, take it. If no multiplier has the wrong sign, it is the solution. Otherwise let go of all held
//      unknowns with wrong signs and go to 1 with the subproblem so enlarged.
// Why it ends: repeating 1-2 only adds held unknowns, so after finitely many steps z* is feasible and 3 is reached: z
// is then the minimiser of a subproblem. After 3 the direction z* - z lowers the energy to first order even where a released
// unknown at its bound is pushed outwards and stays (its slope has the right sign to begin with), so t small enough
// gives a decrease, strictly. Energies of subproblem minimisers therefore fall strictly, no subproblem comes twice, and there are
// finitely many. A subproblem minimiser that comes back anyway means that the energies differ by rounding only: status
// cycling. Sources: Bertsekas, Projected Newton methods for optimization problems with simple constraints (1982): the
// projected step and its descent; More and Toraldo, On the solution of large quadratic programming problems with bound
// constraints (1991): finishing a subproblem before leaving it.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/contact/subproblem.hpp>

#include <span>

namespace plastron::contact {

/// Starts from the minimiser on the subproblem of `initial`, projected onto the box; if a motion is free there, from the
/// minimiser with all bounds active. (collective)
BoxSolution solve_projected_search(const BoxProblem& problem, std::span<const Activity> initial,
                                   algebra::Preconditioner& preconditioner, const Settings& settings = {},
                                   const Observer& observer = {});

/// Goes on from `so_far.z`, projected onto the box; its iterations are kept and count towards the limit.
void continue_projected_search(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                               const Observer& observer, BoxSolution& so_far);

}  // namespace plastron::contact

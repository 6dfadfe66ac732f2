// The projected search: the safeguard of the primal-dual method, with a proof that it ends; also a solver of its own.
// It keeps a feasible z and lowers the energy E at each step:
//   1. Fix the unknowns at bounds; let z* minimise E on this subproblem.
//   2. If z* is outside the box, search along the projection P(z + t (z* - z)), t = 1, 1/2, ..., for the lowest energy
//      that is less than E(z) by a fraction of the slope. Fix also the unknowns that have reached a bound, and go to 1.
//   3. If z* is feasible, take it. If no multiplier has the wrong sign, it is the solution. Otherwise release all fixed
//      unknowns with wrong signs and go to 1 with this larger subproblem.
// Proof that it ends: steps 1-2 only add fixed unknowns, so after finitely many steps z* is feasible and 3 is reached.
// Then z is the minimiser of a subproblem. After 3 the direction z* - z lowers the energy to first order. This is true
// even where a released unknown at its bound is pushed outwards and stays, because its slope first has the right sign.
// Hence a small enough t gives a strict decrease. Energies of subproblem minimisers therefore decrease strictly, and no
// subproblem occurs twice. Their number is finite. If a subproblem minimiser occurs again nevertheless, the energies
// differ by rounding only: status cycling. Sources: Bertsekas, Projected Newton methods for optimization problems with
// simple constraints (1982): the projected step and its descent; More and Toraldo, On the solution of large quadratic
// programming problems with bound constraints (1991): finishing a subproblem before leaving it.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/contact/subproblem.hpp>

#include <span>

namespace plastron::contact {

/// Solves the problem. It starts from the minimiser on the subproblem of `initial`, projected onto the box. If a motion
/// is free there, it starts from the minimiser with all bounds active. (collective)
BoxSolution solve_projected_search(const BoxProblem& problem, std::span<const Activity> initial,
                                   algebra::Preconditioner& preconditioner, const Settings& settings = {},
                                   const Observer& observer = {});

/// Continues from `so_far.z`, projected onto the box. Its iterations are kept and are part of the limit.
void continue_projected_search(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                               const Observer& observer, BoxSolution& so_far);

}  // namespace plastron::contact

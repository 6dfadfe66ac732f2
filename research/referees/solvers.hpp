// Contact solvers that check those of the library by other methods. They are slower (docs/methods/contact.md).
#pragma once
#include <plastron/contact/solve.hpp>

#include <array>

namespace plastron::referees {

/// TAOBNLS of PETSc (bounded_newton.hpp), then one subproblem on its last set. Equations are solved by dual ascent,
/// pressing forces by the pressing search. An iteration of PETSc is an iteration of the solution. (collective)
contact::BoxSolution solve_tao(const contact::BoxProblem& problem, std::span<const contact::Activity> initial,
                               algebra::Preconditioner& preconditioner, const contact::Settings& settings = {},
                               const contact::Observer& observer = {});

/// Modified proportioning with reduced gradient projections, preconditioned in the face: one factorisation serves all
/// faces (docs/research/mprgp.md). The preconditioner fixes the starting set: `initial`, or all bounds if a motion is
/// free there. An iteration of the solution ends with the release of unknowns or with the end of the solver.
/// Conjugate-gradient steps and expansions are its linear_steps; too many end with the status linear_solver_stalled.
/// Equations and pressing forces as above. (collective)
contact::BoxSolution solve_mprgp(const contact::BoxProblem& problem, std::span<const contact::Activity> initial,
                                 algebra::Preconditioner& preconditioner, const contact::Settings& settings = {},
                                 const contact::Observer& observer = {});

struct NamedSolver {
  const char* name;
  contact::SolverFunction* solve;
};

/// The solvers of the library and the referees, in the order of comparisons.
inline constexpr std::array<NamedSolver, 4> all_solvers{{{"active-set", contact::solve_primal_dual_active_set},
                                                         {"projected", contact::solve_projected_search},
                                                         {"tao", solve_tao},
                                                         {"mprgp", solve_mprgp}}};

}  // namespace plastron::referees

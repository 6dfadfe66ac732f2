// Searches that go beyond active sets on a box. Each has its algorithm, its proof or its source at the top of its file:
//   projected_search.cc  lowers the energy from set to set, so that no set returns;
//   proximal_point.cc    continues from a set that leaves a motion free;
//   dual_ascent.cc       finds the multipliers of equations, around a solver of boxes;
//   pressing_search.cc   finds the positions of pressing forces, around a solver of fixed bounds.
// The functions continue_... start from the solution so far. They keep its iterations, which are part of the limit, and
// mark further ones `safeguarded`.
#pragma once
#include <plastron/contact/subproblem.hpp>

namespace plastron::contact {

/// Continues a box problem without equations from `so_far.z`, projected onto the box. Ends with not_held where a set
/// leaves a motion free. (collective)
void continue_projected_search(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                               const Observer& observer, BoxSolution& so_far);

/// Continues a box problem without equations from the set `so_far.activity`, on which `subproblems` found a free
/// motion. `shifted_solver` solves problems with a positive shift, which have no free motions. If no bound stops the
/// motion, the status is not_held. It is singular if even all bounds together leave the motion free. (collective)
void continue_proximal_points(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                              const Observer& observer, SolverFunction& shifted_solver, BoxSolution& so_far);

/// Solves a problem with equations from q = 0. The iterations of `box_solver` and each subproblem with equations are
/// iterations of the solution. max_iterations limits their sum. Status cycling: the dual function cannot increase
/// beyond rounding. Status infeasible: it increases without limit, so the equations cannot be satisfied within the
/// bounds. (collective)
BoxSolution solve_by_dual_ascent(const BoxProblem& problem, std::span<const Activity> initial,
                                 algebra::Preconditioner& preconditioner, const Settings& settings,
                                 const Observer& observer, SolverFunction& box_solver);
/// Continues from the multipliers q and the active set of `so_far`. (collective)
void continue_dual_ascent(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings,
                          const Observer& observer, SolverFunction& box_solver, BoxSolution& so_far);

/// Solves a problem with pressing forces, starting from the bordered subproblem of `initial`. The iterations of
/// `box_solver`, which treats the equations, and each bordered subproblem are iterations of the solution.
/// max_iterations limits their sum. Status infeasible: the forces press bounds against each other. Status not_carried:
/// the energy decreases without limit. (collective)
BoxSolution solve_by_pressing_search(const BoxProblem& problem, std::span<const Activity> initial,
                                     algebra::Preconditioner& preconditioner, const Settings& settings,
                                     const Observer& observer, SolverFunction& box_solver);
/// Continues from the positions and the active set of `so_far`. (collective)
void continue_pressing_search(const BoxProblem& problem, algebra::Preconditioner& preconditioner,
                              const Settings& settings, const Observer& observer, SolverFunction& box_solver,
                              BoxSolution& so_far);

}  // namespace plastron::contact

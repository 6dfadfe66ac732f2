// The contact solvers. README.md shows who calls whom.
#pragma once
#include <plastron/contact/settings.hpp>
#include <plastron/contact/subproblem.hpp>

namespace plastron::contact {

/// The primal-dual active set method (active_set_steps.hpp) with its safeguards (searches.hpp). Where a set returns or
/// the number of changes has not decreased for many iterations, a search continues that cannot cycle:
/// - for bounds alone the projected search;
/// - with equations the dual ascent, with the projected search inside;
/// - with pressing forces the pressing search, with this method inside. With equations too, from the start.
/// Where a set leaves a motion free, proximal points continue, if there are neither equations nor pressing forces. With
/// these, the method starts with the unknowns that touch at z = 0, or with all bounds active. (collective)
BoxSolution solve_primal_dual_active_set(const BoxProblem& problem, std::span<const Activity> initial,
                                         algebra::Preconditioner& preconditioner, const Settings& settings = {},
                                         const Observer& observer = {});

/// The projected search from the start. It begins with the minimiser on the subproblem of `initial`, projected onto the
/// box. If a motion is free there, it begins with the minimiser with all bounds active. (collective)
BoxSolution solve_projected_search(const BoxProblem& problem, std::span<const Activity> initial,
                                   algebra::Preconditioner& preconditioner, const Settings& settings = {},
                                   const Observer& observer = {});

/// Continues a problem with bounds alone from `so_far.z` by the projected search and, where that meets a free motion,
/// by proximal points. (collective)
void continue_on_box(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                     const Observer& observer, BoxSolution& so_far);

/// Returns the solver of the settings.
SolverFunction& solver_of(const Settings& settings);

/// Solves with the solver of the settings. (collective)
BoxSolution solve(const BoxProblem& problem, std::span<const Activity> initial, algebra::Preconditioner& preconditioner,
                  const Settings& settings = {}, const Observer& observer = {});

}  // namespace plastron::contact

// The contact solver that the settings name.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <span>

namespace plastron::contact {

/// What all contact solvers look like: minimises 1/2 z' A z - b' z over the box, with B z = 0 where there are equations,
/// and over the positions of pressing forces. `initial`
/// is the active set to start from (owned unknowns; empty: nothing active), `preconditioner` belongs to problem.matrix.
/// How it ended is the result's status; throws std::invalid_argument for an initial set of a wrong size. (collective)
using SolverFunction = BoxSolution(const BoxProblem& problem, std::span<const Activity> initial,
                                   algebra::Preconditioner& preconditioner, const Settings& settings,
                                   const Observer& observer);

/// The function behind a name.
SolverFunction& function_of(Solver solver);

/// Solves with settings.solver. (collective)
BoxSolution solve(const BoxProblem& problem, std::span<const Activity> initial, algebra::Preconditioner& preconditioner,
                  const Settings& settings = {}, const Observer& observer = {});

}  // namespace plastron::contact

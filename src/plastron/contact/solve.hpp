// The contact solver that the settings name.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <span>

namespace plastron::contact {

/// Type of all contact solvers: minimises 1/2 z' A z - b' z over the box and over the positions of pressing forces,
/// with B z = 0 where there are equations. `initial` is the starting active set (owned unknowns; empty: nothing
/// active), `preconditioner` belongs to problem.matrix. The result has the status. Throws std::invalid_argument for an
/// initial set of a wrong size. (collective)
using SolverFunction = BoxSolution(const BoxProblem& problem, std::span<const Activity> initial,
                                   algebra::Preconditioner& preconditioner, const Settings& settings,
                                   const Observer& observer);

/// Returns the function of a solver.
SolverFunction& function_of(Solver solver);

/// Solves with settings.solver. (collective)
BoxSolution solve(const BoxProblem& problem, std::span<const Activity> initial, algebra::Preconditioner& preconditioner,
                  const Settings& settings = {}, const Observer& observer = {});

}  // namespace plastron::contact

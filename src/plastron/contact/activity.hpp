// Active sets: where each unknown stands, as the contact solvers pass it around. Functions of all ranks are collective.
#pragma once
#include <plastron/contact/problem.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace plastron::contact {

/// Of the owned unknowns, one after the other.
using ActiveSet = std::vector<Activity>;

/// Asserts that load and bounds fit the matrix: layout, block, sizes. What they say is another matter (bounds_are_consistent).
void assert_fits_together(const BoxProblem& problem);

/// lower <= upper everywhere, on all ranks, and no bound is NaN. Bounds that pressing forces move against each other are left out:
/// whether they cross is a matter of the positions (at_positions).
bool bounds_are_consistent(const BoxProblem& problem);

/// `initial` where it makes sense, that is where the bound exists; prescribed unknowns marked. Empty: nothing active.
ActiveSet starting_set(const BoxProblem& problem, std::span<const Activity> initial);
/// Every unknown that has a bound at a bound, at the one nearer to zero if it has two.
ActiveSet everything_active(const BoxProblem& problem);

/// Every unknown that z has at a bound, or beyond, at that bound.
ActiveSet everything_at_bounds(const BoxProblem& problem, const algebra::Vector& z);
/// z with every unknown that is beyond a bound at that bound, ghosts up to date. (collective)
algebra::Vector project(const BoxProblem& problem, algebra::Vector z);

/// Zeros of the right size, nothing active, and the status: where a solver starts from.
BoxSolution unsolved(const BoxProblem& problem, Status status);

/// The bound at which an active or prescribed unknown is held.
double held_at(const BoxProblem& problem, std::size_t i, Activity activity);

/// Unknowns at a bound, prescribed ones not counted, on all ranks.
std::int64_t count_active(const BoxProblem& problem, const ActiveSet& set);
/// Unknowns that stand differently in the two sets, on all ranks.
std::int64_t count_changes(const BoxProblem& problem, const ActiveSet& before, const ActiveSet& after);
/// A number that tells active sets apart, the same on all ranks and however the unknowns are spread over them.
std::uint64_t fingerprint(const BoxProblem& problem, const ActiveSet& set);

}  // namespace plastron::contact

// Active sets: the activity of each unknown in the contact solvers. Functions over all ranks are collective.
#pragma once
#include <plastron/contact/problem.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace plastron::contact {

/// Activities of the owned unknowns, in their order.
using ActiveSet = std::vector<Activity>;

/// Asserts that load and bounds fit the matrix in layout, block and size. It does not check their values
/// (bounds_are_consistent).
void assert_fits_together(const BoxProblem& problem);

/// Whether lower <= upper everywhere, on all ranks, and no bound is NaN. Bounds that pressing forces move against each
/// other are not checked: their positions determine whether they cross (at_positions).
bool bounds_are_consistent(const BoxProblem& problem);

/// Returns `initial` where the bound exists, with prescribed unknowns marked. Empty `initial`: nothing is active.
ActiveSet starting_set(const BoxProblem& problem, std::span<const Activity> initial);
/// Returns a set with every unknown at a bound, if it has one. Of two bounds the one nearer to zero is taken.
ActiveSet everything_active(const BoxProblem& problem);

/// Returns a set with every unknown at a bound that z has at this bound or beyond it.
ActiveSet everything_at_bounds(const BoxProblem& problem, const algebra::Vector& z);
/// Returns z with every unknown that is beyond a bound moved to that bound, with current ghosts. (collective)
algebra::Vector project(const BoxProblem& problem, algebra::Vector z);

/// Returns a solution of the right size for the start of a solver: zeros, nothing active, and the status.
BoxSolution unsolved(const BoxProblem& problem, Status status);

/// Returns the bound at which an active or prescribed unknown is fixed.
double held_at(const BoxProblem& problem, std::size_t i, Activity activity);

/// Number of unknowns at a bound on all ranks, without prescribed ones.
std::int64_t count_active(const BoxProblem& problem, const ActiveSet& set);
/// Number of unknowns whose activity differs between the two sets, on all ranks.
std::int64_t count_changes(const BoxProblem& problem, const ActiveSet& before, const ActiveSet& after);
/// Returns a number that distinguishes active sets. It is equal on all ranks and does not depend on the distribution of
/// the unknowns.
std::uint64_t fingerprint(const BoxProblem& problem, const ActiveSet& set);

}  // namespace plastron::contact

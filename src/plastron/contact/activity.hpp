// Active sets: the activity of each unknown in the contact solvers, and steps in the box. Functions over all ranks are
// collective.
#pragma once
#include <plastron/contact/problem.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace plastron::contact {

/// Activities of the owned unknowns, in their order.
using ActiveSet = std::vector<Activity>;

/// An unknown that is at a bound although its set marks it as free.
struct Touch {
  std::size_t unknown;
  Activity activity;
};

/// Returns `initial` where the bound exists, with prescribed unknowns marked. Empty `initial`: nothing is active.
ActiveSet starting_set(const BoxProblem& problem, std::span<const Activity> initial);
/// Returns a set with every unknown at a bound, if it has one. Of two bounds the one nearer to zero is taken.
ActiveSet everything_active(const BoxProblem& problem);

/// Returns a set with every unknown at a bound that z has at this bound or beyond it.
ActiveSet everything_at_bounds(const BoxProblem& problem, const algebra::Vector& z);
/// Returns the bound at which an active or prescribed unknown is fixed.
double bound_at(const BoxProblem& problem, std::size_t i, Activity activity);
/// Marks the unknowns that a set fixes: active and prescribed ones.
std::vector<char> fixed_by(const ActiveSet& set);

/// Number of unknowns at a bound on all ranks, without prescribed ones.
std::int64_t count_active(const BoxProblem& problem, const ActiveSet& set);
/// Number of unknowns whose activity differs between the two sets, on all ranks.
std::int64_t count_changes(const BoxProblem& problem, const ActiveSet& before, const ActiveSet& after);
/// Returns a number that distinguishes active sets. It is equal on all ranks and does not depend on the distribution of
/// the unknowns.
std::uint64_t fingerprint(const BoxProblem& problem, const ActiveSet& set);

// Steps that stay in the box.

/// Returns z with every unknown that is beyond a bound moved to that bound, with current ghosts. (collective)
algebra::Vector project(const BoxProblem& problem, algebra::Vector z);
/// Returns the largest t with x - t d in the box; infinity if no bound limits it. (collective)
double largest_feasible_step(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                             const algebra::Vector& d);
/// Returns P(x - t d), exactly at the bounds that it reaches, with current ghosts. (collective)
algebra::Vector clamped_step(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                             const algebra::Vector& d, double t);

}  // namespace plastron::contact

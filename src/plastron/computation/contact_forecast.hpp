// Predicts the nodes in contact before a contact problem is solved: the start of the active set, and the places where
// it may change.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/contact/activity.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <vector>

namespace plastron::computation {

// A zone is a vector of a value for each node and obstacle: 1 in contact, 0 not in contact, between where it is open;
// above one half if contact is more likely.

/// Returns roots of gaps, negative where nodes touch. A finer mesh gets them in addition to NodalSolution::touching
/// (collective).
algebra::Vector continued_roots(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

/// Returns the zone on a finer mesh, from both fields interpolated from the mesh before.
algebra::Vector interpolated_zone(algebra::Vector touching, const algebra::Vector& roots);

/// Marks owned coordinates whose side the zone leaves open. Empty if the zone leaves no side open.
std::vector<char> open_coordinates(const assembly::DiscreteShell& discrete, const algebra::Vector& zone);

/// Distance of each node from a change of contact, by obstacle; owned values.
struct ContactTrend {
  algebra::Vector touching;     ///< 1 or 0
  algebra::Vector pressure;     ///< [Pa]
  algebra::Vector root_of_gap;  ///< goes to 0 nearly linearly towards the zone's edge [m^1/2]
};

/// Returns the trend of a solution at its state.
ContactTrend contact_trend(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

/// Extrapolates the trend linearly. The time step is `ahead` times the step from `before` to `now`.
ContactTrend continued(ContactTrend now, const ContactTrend& before, double ahead);

/// Returns the expected zone: nodes that touched stay where the pressure is positive, others enter where the root is
/// negative. Open are the nodes that change sides and the nodes of cells that the zone's edge crosses (collective).
algebra::Vector expected_zone(const assembly::DiscreteShell& discrete, const ContactTrend& expected);

}  // namespace plastron::computation

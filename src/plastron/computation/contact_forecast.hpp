// Which nodes will be in contact, before a contact problem is solved: what the active set starts from, and where it may still change.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/certificate/certificate.hpp>
#include <plastron/contact/activity.hpp>

#include <vector>

namespace plastron::computation {

// A zone is a vector of a value for each node and obstacle: 1 in contact, 0 not, in between where that is open, above one half if contact is more likely.

/// Roots of gaps, negative where nodes touch: what a finer mesh shall be told beside NodalSolution::touching (collective).
algebra::Vector continued_roots(const assembly::DiscreteShell& discrete, const certificate::NodalSolution& solution);

/// The zone on a finer mesh, of both as the mesh before interpolates them.
algebra::Vector interpolated_zone(algebra::Vector touching, const algebra::Vector& roots);

/// Each bound on its likely side. Of owned coordinates.
std::vector<contact::Activity> likely_activity(const assembly::DiscreteShell& discrete, const algebra::Vector& zone);

/// Marks of owned coordinates whose side the zone leaves open. Empty if there are none.
std::vector<char> open_coordinates(const assembly::DiscreteShell& discrete, const algebra::Vector& zone);

/// How near each node is to the other side of contact, by obstacle; owned values.
struct ContactTrend {
  algebra::Vector touching;     ///< 1 or 0
  algebra::Vector pressure;     ///< [Pa]
  algebra::Vector root_of_gap;  ///< which goes to 0 about linearly towards the zone's edge [m^1/2]
};

/// Of a solution at the state where it was found.
ContactTrend contact_trend(const assembly::DiscreteShell& discrete, const certificate::NodalSolution& solution);

/// What follows after a time, `ahead` times as long as from `before` to `now`, if all goes on as it went.
ContactTrend continued(ContactTrend now, const ContactTrend& before, double ahead);

/// The zone that follows: nodes that touched stay where the pressure is positive, the others come where the root is negative. Open are the nodes
/// that change sides and those of cells which the zone's edge crosses (collective).
algebra::Vector expected_zone(const assembly::DiscreteShell& discrete, const ContactTrend& expected);

}  // namespace plastron::computation

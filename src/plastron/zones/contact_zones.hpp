// The contact report of a solution: zones of each obstacle, the connected components of the nodes that touch it.
// Nodes are neighbours if they are corners of one sub-cell (sub_cells.hpp), also across joined edges.
#pragma once
#include <plastron/solution/contact_zone.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <vector>

namespace plastron::zones {

/// Returns the zones by obstacle; large zones first, equal ones by their place (collective). The result is the same
/// on every rank and, up to rounding, on any number of ranks. Throws the exceptions of the chart at points between
/// nodes, on all ranks together.
std::vector<std::vector<solution::ContactZone>> contact_zones(const assembly::DiscreteShell& discrete,
                                                              const solution::NodalSolution& solution);

/// Returns by obstacle the mid-surface area in contact, within the boundaries of its zones [m^2] (collective). Throws
/// like contact_zones().
std::vector<double> contact_areas(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

}  // namespace plastron::zones

// The contact report of a solution: zones of each obstacle, that is the connected components of the nodes that touch it. Nodes are
// neighbours where they are corners of one sub-cell (sub_cells.hpp), also across joined edges.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/certificate/contact_zone.hpp>

#include <vector>

namespace plastron::certificate {

struct NodalSolution;

/// By obstacle; large zones first, equal ones by their place. The same on every rank and, up to rounding, on any number of them
/// (collective). Throws what the chart throws at points between nodes, on all ranks together.
std::vector<std::vector<ContactZone>> contact_zones(const assembly::DiscreteShell& discrete,
                                                    const NodalSolution& solution);

/// By obstacle: the mid-surface area that touches it, within the boundaries of its zones [m^2] (collective). Throws likewise.
std::vector<double> contact_areas(const assembly::DiscreteShell& discrete, const NodalSolution& solution);

}  // namespace plastron::certificate

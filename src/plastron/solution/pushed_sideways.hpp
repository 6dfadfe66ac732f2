// Nodes that an obstacle pushes along the shell, out of a place deep inside it.
#pragma once
#include <plastron/solution/nodal_solution.hpp>
#include <plastron/solution/summary.hpp>

namespace plastron::solution {

/// Counts these nodes of each obstacle in `summary`, and the part of the reaction that they carry (collective).
void add_pushed_sideways(const assembly::DiscreteShell& discrete, const NodalSolution& solution, Summary& summary);

}  // namespace plastron::solution

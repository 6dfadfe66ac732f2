// The gap between the nodes, where no bound holds it: measured and reported (M21).
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

namespace plastron::certificate {

using geometry::Vector3d;

/// Smallest gap on a lattice of 2k + 1 points a side, five at least, in every cell that is near the obstacle; +infinity without
/// obstacle or without such cells (collective).
double min_gap_between_nodes(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

}  // namespace plastron::certificate

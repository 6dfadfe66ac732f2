// The gap between the nodes, where no bound holds it: measured and reported (M21), or bounds lifted until it is not negative
// (computation/bound_lifts.hpp).
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <functional>
#include <optional>
#include <span>

namespace plastron::certificate {

using geometry::Vector3d;

/// Of an owned cell and an obstacle near it: the gaps at the points of a lattice.
using GapVisitor = std::function<void(std::size_t cell, std::size_t obstacle, std::span<const double> gaps)>;
/// Visits the owned cells and the obstacles near them with the gaps on fem::lattice() of so many intervals a side. Throws ObstacleError
/// on this rank alone.
void sample_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y, int intervals,
                 const GapVisitor& visit);

/// Smallest gap on a lattice of 2k intervals a side, four at least, or of as many as are given, in every cell that is near the obstacle;
/// +infinity without obstacle or without such cells (collective).
double min_gap_between_nodes(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                             std::optional<int> intervals = {});

}  // namespace plastron::certificate

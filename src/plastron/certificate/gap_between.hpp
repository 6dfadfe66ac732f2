// The gap between the nodes, where no bound holds it: searched, measured and reported (M21), or bounds lifted until it is not negative
// (computation/bound_lifts.hpp).
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace plastron::certificate {

using geometry::Vector3d;

/// Of an owned cell and an obstacle near it: the gaps at the points of a lattice.
using GapVisitor = std::function<void(std::size_t cell, std::size_t obstacle, std::span<const double> gaps)>;
/// Visits the owned cells and the obstacles near them with the gaps on fem::lattice() of so many intervals a side. Throws ObstacleError
/// on this rank alone.
void sample_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y, int intervals,
                 const GapVisitor& visit);

/// The least gap between an owned cell and an obstacle near it.
struct CellGap {
  std::size_t cell, obstacle;
  double gap;         ///< [m]
  Eigen::Vector2d x;  ///< where, parameters in Omega
};

/// Obstacles smaller than a cell are searched for, too: pieces of cells are divided until each is farther from the obstacle than it is
/// large, or smaller than the obstacle's roundings (docs/methods/contact.md). Throws ObstacleError on this rank alone.
std::vector<CellGap> searched_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

/// Smallest gap on a lattice of so many intervals a side in every cell that is near the obstacle; +infinity without obstacle or without
/// such cells (collective).
double min_gap_on_lattice(const assembly::DiscreteShell& discrete, const algebra::Vector& y, int intervals);

}  // namespace plastron::certificate

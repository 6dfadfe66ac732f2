// The gap between the nodes, where no bound constrains it: searched, measured and reported (M21). Lifted bounds can
// make it non-negative (computation/bound_lifts.hpp).
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace plastron::certificate {

using geometry::Vector3d;

/// Receives an owned cell, an obstacle near it and the gaps at the points of a lattice.
using GapVisitor = std::function<void(std::size_t cell, std::size_t obstacle, std::span<const double> gaps)>;
/// Visits the owned cells and the obstacles near them with the gaps on mesh::lattice() with `intervals` per side.
/// Throws ObstacleError on this rank alone.
void sample_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y, int intervals,
                 const GapVisitor& visit);

/// The least gap between an owned cell and an obstacle near it.
struct CellGap {
  std::size_t cell, obstacle;
  double gap;         ///< [m]
  Eigen::Vector2d x;  ///< place, parameters in Omega
};

/// Searches the least gaps, also to obstacles smaller than a cell. Divides pieces of cells until each is farther from
/// the obstacle than its own size, or smaller than the obstacle's roundings (docs/methods/contact.md). Throws
/// ObstacleError on this rank alone.
std::vector<CellGap> searched_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

/// The smallest gap on a lattice with `intervals` per side in all cells near an obstacle (collective). +infinity
/// without obstacles or without such cells.
double min_gap_on_lattice(const assembly::DiscreteShell& discrete, const algebra::Vector& y, int intervals);

}  // namespace plastron::certificate

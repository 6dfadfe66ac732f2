// The gap between the nodes, where no bound constrains it: searched, measured and reported (M21). Lifted bounds can
// make it non-negative (computation/bound_lifts.hpp).
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace plastron::certificate {

using geometry::Vector3d;

/// Returns the gaps at points of a cell.
using GapsAt = std::function<std::vector<double>(const element::BasisAt&)>;
/// Visits the owned cells and the obstacles near them. Throws ObstacleError on this rank alone.
void visit_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                const std::function<void(std::size_t cell, std::size_t obstacle, const GapsAt&)>& visit);

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

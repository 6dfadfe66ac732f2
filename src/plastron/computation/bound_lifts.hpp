// Bounds of gaps at nodes, lifted until the shell is outside the obstacles also between its nodes
// (docs/methods/admissible.md). The loop: solve, find the deepest place of every cell, lift the bounds of the cell's
// nodes by that depth, solve again; at the end lower the lifts that are too large.
#pragma once
#include <plastron/solution/nodal_solution.hpp>

#include <limits>
#include <optional>

namespace plastron::computation {

/// The loop of one mesh at one instant.
class BoundLifts {
 public:
  explicit BoundLifts(const assembly::DiscreteShell& discrete) : discrete_(discrete) {}

  /// Returns the lifts of the next solution, block: obstacles. Nothing where the shell is outside, or where lifts give
  /// no further gain (collective). Throws ObstacleError.
  std::optional<algebra::Vector> next(const solution::NodalSolution& solution);
  int rounds() const { return rounds_; }

 private:
  const assembly::DiscreteShell& discrete_;
  int rounds_ = 0, rounds_without_gain_ = 0, lowerings_ = 0;
  double least_depth_ = std::numeric_limits<double>::infinity();
};

/// Returns the largest decrease of the gap between the nodes of a cell, among all cells near an obstacle.
/// The decrease is measured from the least gap at the cell's nodes that have weight. Lifts must compensate this
/// decrease (collective) [m]. Throws ObstacleError.
double largest_dip(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

}  // namespace plastron::computation

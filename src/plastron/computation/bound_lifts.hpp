// Bounds of gaps at nodes, lifted until the shell is out of the obstacles between its nodes, too (docs/methods/admissible.md): solve,
// look for the deepest place of every cell, lift the bounds of the cell's nodes by that depth, solve again.
#pragma once
#include <plastron/certificate/certificate.hpp>

#include <limits>
#include <optional>

namespace plastron::computation {

/// One mesh's loop at one instant. Lifts only grow in it.
class BoundLifts {
 public:
  explicit BoundLifts(const assembly::DiscreteShell& discrete) : discrete_(discrete) {}

  /// The lifts to solve with next, block: obstacles; nothing where the shell is out, or lifts bring it no further (collective).
  /// Throws ObstacleError.
  std::optional<algebra::Vector> next(const certificate::NodalSolution& solution);
  int rounds() const { return rounds_; }

 private:
  const assembly::DiscreteShell& discrete_;
  int rounds_ = 0, rounds_without_gain_ = 0;
  double least_depth_ = std::numeric_limits<double>::infinity();
};

/// How far gaps fall between the nodes of a cell below the least of those at its nodes that bounds hold, the most of all cells near an
/// obstacle: what lifts are there to make up for (collective) [m]. Throws ObstacleError.
double largest_dip(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

}  // namespace plastron::computation

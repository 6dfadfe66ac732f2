// Depth of the shell in an obstacle anywhere in a cell, from gaps on a lattice (docs/methods/admissible.md).
#pragma once
#include <plastron/mesh/reference_cell.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace plastron::computation {

/// Lower bound of a function from its values at the points of mesh::lattice().
class LatticeBound {
 public:
  LatticeBound(mesh::Shape shape, int intervals);  ///< at least two intervals

  /// Returns a bound of the function in the sub-cells at point p, exact for quadratic functions. It is the value there
  /// minus an eighth of the positive second differences through it. The reason: a function that is convex along a line
  /// is below its chords there.
  double at(std::size_t p, std::span<const double> values) const;

 private:
  using Line = std::array<std::size_t, 3>;  ///< three neighbours in order; the point may be any of them
  std::vector<std::vector<Line>> lines_;    ///< lines of each point, in the directions of the lattice's sides
};

}  // namespace plastron::computation

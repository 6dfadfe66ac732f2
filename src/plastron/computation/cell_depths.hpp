// How deep the shell is in an obstacle anywhere in a cell, from gaps on a lattice (docs/methods/admissible.md).
#pragma once
#include <plastron/fem/reference_cell.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace plastron::computation {

/// Bounds a function from below by its values at the points of fem::lattice().
class LatticeBound {
 public:
  LatticeBound(fem::Shape shape, int intervals);  ///< two intervals at least

  /// A bound of the function in the sub-cells at point p, exact for quadratic functions: the value there minus an eighth of the second
  /// differences through it, those that are positive, for a function that is convex along a line lies below its chords there.
  double at(std::size_t p, std::span<const double> values) const;

 private:
  using Line = std::array<std::size_t, 3>;  ///< neighbours one after the other; the point may be any of them
  std::vector<std::vector<Line>> lines_;    ///< of each point, in the directions of the lattice's sides
};

}  // namespace plastron::computation

// How large the cells of the finest mesh are, how thick the shell is there, and how large the shell is.
#pragma once
#include <plastron/study/problem.hpp>

#include <vector>

namespace plastron::study {

/// Of the finest mesh, seen on a mesh of some hundred cells.
struct CellSizes {
  struct Cell {
    double longest_side;  ///< h [m]
    double thickness;     ///< the smallest at its corners, e [m]
  };
  std::vector<Cell> cells;
  double extent = 0;  ///< L: half the diagonal of the box that holds the mid-surface [m]
};

/// Each rank looks at the whole problem for itself. Precondition: a regular chart and a positive thickness.
CellSizes cell_sizes(const Problem& problem);

}  // namespace plastron::study

// How large the cells of the finest mesh are, and how thick the shell is there.
#pragma once
#include <plastron/computation/problem.hpp>

#include <vector>

namespace plastron::computation {

struct CellSize {
  double longest_side;  ///< h [m]
  double thickness;     ///< the smallest at its corners, e [m]
};

/// Cells of the finest mesh, seen on a mesh of some hundred cells; each rank looks at the whole problem for itself.
/// Precondition: a regular chart and a positive thickness.
std::vector<CellSize> cell_sizes(const Problem& problem);

}  // namespace plastron::computation

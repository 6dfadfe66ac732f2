// Size of the cells of the finest mesh, and the shell's thickness there.
#pragma once
#include <plastron/problem/problem.hpp>

#include <vector>

namespace plastron::meshing {

struct CellSize {
  double longest_side;  ///< h [m]
  double thickness;     ///< the smallest at its corners, e [m]
};

/// Returns cells of the finest mesh, sampled on a mesh of some hundred cells. Each rank computes all of them.
/// Precondition: a regular chart and a positive thickness.
std::vector<CellSize> cell_sizes(const problem::Problem& problem);

}  // namespace plastron::meshing

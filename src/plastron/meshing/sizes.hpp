// Lengths of a shell and of its cells, sampled on a mesh of some hundred cells. Each rank computes all of them, and they
// are the same on every rank.
#pragma once
#include <plastron/problem/problem.hpp>

#include <vector>

namespace plastron::meshing {

/// Returns L, half the diagonal of the box around the mid-surface [m], the unit of length of a shell. It is the same for
/// every mesh.
double extent(const problem::Problem& problem);

/// Size of a cell of the finest mesh.
struct CellSize {
  double longest_side;  ///< h [m]
  double thickness;     ///< the smallest at its corners, e [m]
};
/// Returns some of the cells of the finest mesh. Precondition: a regular chart and a positive thickness.
std::vector<CellSize> cell_sizes(const problem::Problem& problem);

}  // namespace plastron::meshing

// Where the shell lies inside an obstacle though its nodes obey their bounds: between its nodes, and where a nodal gap is
// measured to the wrong surface of the obstacle.
#pragma once
#include <plastron/certificate/gap_between.hpp>
#include <plastron/solution/summary.hpp>

#include <vector>

namespace plastron::certificate {

/// Marks the owned cells at rigid bodies: no bound keeps a body's nodes out of obstacles.
std::vector<char> cells_of_bodies(const fem::Space& space);

/// Searches the least gap to each obstacle in the cells of all ranks and writes it to `summary` with its place. Cells at
/// rigid bodies do not count. Returns this rank's cells with a gap below 0 (collective).
std::vector<CellGap> add_least_gaps(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                                    solution::Summary& summary);

/// Counts the nodes that each obstacle pushes along the shell, out of a place deep inside it, and the part of the
/// reaction that they carry. Writes both to `summary` (collective).
void add_pushed_nodes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                      solution::Summary& summary);

}  // namespace plastron::certificate

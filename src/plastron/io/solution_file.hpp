// solution.plastron: the finest solution with all its digits, for `plastron verify` (docs/results.md describes the
// bytes).
//
// A header, then a record for each cell: the place of the cell, and the values at its nodes. Cells are identified by
// their place in the coarse mesh, so that neither the number of ranks nor their order matters. A node is in the record
// of each of its cells.
#pragma once
#include <plastron/computation/verify.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/unusable_results.hpp>

#include <filesystem>
#include <vector>

namespace plastron::io {

/// Adds the file (collective). Throws std::runtime_error.
void add_solution(const computation::Solution& solution, const std::filesystem::path& path, AtomicFiles& files);

/// Returns the places of a file's cells, which define its mesh (computation::finest_mesh) (collective). Throws
/// UnusableResults.
computation::MeshCells stored_cells(const std::filesystem::path& path, MPI_Comm comm);

/// Data of a problem's solutions besides (u, r).
struct SolutionShape {
  int obstacles = 0;
  bool has_multiplier = false;
  bool has_lifts = false;
};

/// Reads a solution on the mesh of `space`, independent of the ranks that wrote it (collective). Throws
/// UnusableResults: no such file, another format or version, incomplete, another mesh or problem, values that are not
/// finite, or values of a node that differ between cells.
computation::StoredSolution read_solution(const std::filesystem::path& path,
                                          const std::shared_ptr<const fem::Space>& space, const SolutionShape& shape);

}  // namespace plastron::io

// solution.plastron: the finest solution with all its digits, for `plastron verify` (docs/results.md describes the
// bytes).
//
// A header, then a record a cell: where the cell lies, and the values at its nodes. Cells are told apart by their place
// in the coarse mesh, so that neither the number of ranks nor their order matters; a node stands in the record of each
// of its cells.
#pragma once
#include <plastron/computation/verify.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/unusable_results.hpp>

#include <filesystem>
#include <vector>

namespace plastron::io {

/// Adds the file (collective). Throws std::runtime_error.
void add_solution(const computation::Solution& solution, const std::filesystem::path& path, AtomicFiles& files);

/// Where the cells of a file lie, which is the mesh that it belongs to (computation::finest_mesh) (collective). Throws UnusableResults.
computation::MeshCells stored_cells(const std::filesystem::path& path, MPI_Comm comm);

/// What a problem's solutions have besides (u, r).
struct SolutionShape {
  int obstacles = 0;
  bool has_multiplier = false;
  bool has_lifts = false;
};

/// On the mesh of `space`, whatever ranks wrote it (collective). Throws UnusableResults: no such file, another format
/// or version, not complete, of another mesh or problem, values that are not finite, or that differ at a node from cell
/// to cell.
computation::StoredSolution read_solution(const std::filesystem::path& path,
                                          const std::shared_ptr<const fem::Space>& space, const SolutionShape& shape);

}  // namespace plastron::io

// solution.plastron: the finest solution with all its digits, for `plastron verify` (docs/results.md describes the
// bytes).
//
// A header, then a record for each cell: the place of the cell, and the values at its nodes. Cells are identified by
// their place in the coarse mesh, so that neither the number of ranks nor their order matters. A node is in the record
// of each of its cells.
#pragma once
#include <plastron/computation/verify.hpp>
#include <plastron/fem/space.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/results.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace plastron::io {

static_assert(std::endian::native == std::endian::little, "the file holds little-endian numbers");

struct SolutionHeader {
  std::array<char, 8> magic{'P', 'L', 'A', 'S', 'T', 'R', 'O', 'N'};
  std::uint32_t version = 4;
  std::uint32_t corners = 4;  ///< corners of a cell
  std::uint32_t degree = 1;
  std::uint32_t obstacles = 0;
  std::uint32_t has_multiplier = 0;
  /// Gaps are linearised at a displacement, which follows the displacement of each node.
  std::uint16_t is_deformed = 0;
  std::uint16_t has_lifts = 0;  ///< bounds of gaps are lifted: the shell is outside obstacles also between its nodes
  std::int64_t cells = 0;
  std::int64_t nodes = 0;
  double time = 0, loads = 1, supports = 1;  ///< see energy::Factors
  std::int64_t cut_numbers = 0;              ///< length of the list of cuts, see flat_cuts
  std::int64_t path_states = 0;              ///< states on the path from the start that the proof of the path needs

  /// Number of values: u of each state of the path; u, r; (u, r) of the linearisation; lambda; eta, touching and lift of every
  /// obstacle.
  std::size_t values_per_node() const {
    return 3u * static_cast<std::size_t>(path_states) + 6u * (1u + is_deformed) + has_multiplier +
           (2u + has_lifts) * obstacles;
  }
  /// Numbers of the path before the cells: time and positions of the obstacles for each state.
  std::size_t path_numbers() const { return static_cast<std::size_t>(path_states) * (1u + obstacles); }
};
static_assert(sizeof(SolutionHeader) == 88);

/// Data of each obstacle, after the header: distance by which its force moved it before the linearisation of its gaps,
/// and after it [m].
using ObstacleRecord = std::array<double, 2>;

/// The start of a record; values of its nodes follow, node by node.
struct CellHead {
  fem::CellPlace place{};
  std::array<double, 6> at{};  ///< places in Omega of xi = (0, 0), (1, 0) and (0, 1), which differ in another mesh
};
static_assert(sizeof(CellHead) == 64);

CellHead cell_head(const fem::Space& space, std::size_t cell);

/// Returns the cuts of a coarse mesh as a list: number and places for each cell and direction.
std::vector<double> flat_cuts(const std::vector<mesh::Cuts>& cuts);
/// Returns the cuts from a list of flat_cuts; nothing if it is no such list.
std::optional<std::vector<mesh::Cuts>> cuts_of_list(std::span<const double> list);

/// Bytes before the first cell.
inline std::size_t preamble_size(const SolutionHeader& header) {
  return sizeof(SolutionHeader) + header.obstacles * sizeof(ObstacleRecord) +
         (static_cast<std::size_t>(header.cut_numbers) + header.path_numbers()) * sizeof(double);
}

/// Bytes of a cell.
inline std::size_t record_size(const SolutionHeader& header, int nodes_per_cell) {
  return sizeof(CellHead) + static_cast<std::size_t>(nodes_per_cell) * header.values_per_node() * sizeof(double);
}

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

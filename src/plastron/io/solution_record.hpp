// The bytes of solution.plastron, for the one who writes them and the one who reads them. Little-endian, as all
// machines that this program is built for.
#pragma once
#include <plastron/fem/space.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace plastron::io {

static_assert(std::endian::native == std::endian::little);

struct SolutionHeader {
  std::array<char, 8> magic{'P', 'L', 'A', 'S', 'T', 'R', 'O', 'N'};
  std::uint32_t version = 2;
  std::uint32_t corners = 4;  ///< of a cell
  std::uint32_t degree = 1;
  std::uint32_t obstacles = 0;
  std::uint32_t has_multiplier = 0;
  std::uint16_t is_deformed = 0;  ///< gaps are linearised at a displacement that follows each node's own
  std::uint16_t has_lifts = 0;    ///< bounds of gaps are lifted: the shell is out of obstacles between its nodes, too
  std::int64_t cells = 0;
  std::int64_t nodes = 0;
  double time = 0, load_factor = 1;
  std::int64_t cut_numbers = 0;  ///< of the list of cuts, see flat_cuts

  /// u, r; (u, r) of the linearisation; lambda; eta, touching and lift of every obstacle.
  std::size_t values_per_node() const {
    return 6u * (1u + is_deformed) + has_multiplier + (2u + has_lifts) * obstacles;
  }
};
static_assert(sizeof(SolutionHeader) == 72);

/// Of each obstacle, after the header: how far its force had pressed it where its gaps are linearised, and from there [m].
using ObstacleRecord = std::array<double, 2>;

/// The start of a record; values of its nodes follow, node by node.
struct CellHead {
  fem::CellPlace place{};
  std::array<double, 6> at{};  ///< xi = (0, 0), (1, 0) and (0, 1) in Omega: another mesh has others
};
static_assert(sizeof(CellHead) == 64);

CellHead cell_head(const fem::Space& space, std::size_t cell);

/// The cuts of a coarse mesh as a list: of each cell and direction how many, and where.
std::vector<double> flat_cuts(const std::vector<fem::Cuts>& cuts);
/// What flat_cuts made the list of; nothing if it was not.
std::optional<std::vector<fem::Cuts>> cuts_of_list(std::span<const double> list);

/// Bytes before the first cell.
inline std::size_t preamble_size(const SolutionHeader& header) {
  return sizeof(SolutionHeader) + header.obstacles * sizeof(ObstacleRecord) +
         static_cast<std::size_t>(header.cut_numbers) * sizeof(double);
}

/// Bytes of a cell.
inline std::size_t record_size(const SolutionHeader& header, int nodes_per_cell) {
  return sizeof(CellHead) + static_cast<std::size_t>(nodes_per_cell) * header.values_per_node() * sizeof(double);
}

}  // namespace plastron::io

// The deformed surface for a web page: all fields at points of the cells in single precision, on the first rank, no more of them than a page
// can hold.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/fields.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace plastron::io {

/// Cells that are drawn, which may be blocks of the mesh's own.
struct DrawnCells {
  int subdivisions = 1;   ///< lattice of points in each: fem::lattice
  int merged_levels = 0;  ///< a drawn cell is a block of 2^merged_levels of the finest cells a side, or one larger cell
  int levels = 0;         ///< how often the coarse cells were divided for the finest ones
  std::int64_t count = 0;  ///< 0: the page cannot hold the surface
};

/// The finest drawing of at most `most_points` points: subdivisions up to the degree, then one a cell, then blocks of the smallest cells as far
/// as these come from one coarse cell. `cells_by_level`: how many were divided 0, 1, 2, ... times.
DrawnCells drawn_cells(fem::Shape shape, int degree, std::span<const std::int64_t> cells_by_level,
                       std::int64_t most_points);

struct SampledSurface {
  DrawnCells cells;
  std::int64_t points = 0;
  std::vector<Field> fields{};  ///< those that have a meaning here
  std::vector<std::vector<float>>
      rows{};  ///< a row for each component of each field, a value for each point; on the first rank only
};

/// Those that colours tell something of: no tangents, no directions, no places but that of the mid-surface.
std::vector<Field> report_fields(bool has_obstacle, bool has_multiplier);

/// Cells stand in an order that no number of ranks changes (collective). Throws what the chart throws at points between nodes, on all ranks
/// together.
SampledSurface sampled_surface(const computation::Solution& solution, std::int64_t most_points);

}  // namespace plastron::io

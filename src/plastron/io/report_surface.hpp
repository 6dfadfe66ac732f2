// The deformed surface for a web page: all fields at points of the cells in single precision, on the first rank, with a
// limited number of points.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/fields.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace plastron::io {

/// Drawn cells, which may be blocks of the mesh's cells.
struct DrawnCells {
  int subdivisions = 1;  ///< lattice of points in each: fem::lattice
  /// A drawn cell is a block of 2^merged_levels of the finest cells on each side, or one larger cell.
  int merged_levels = 0;
  int levels = 0;          ///< number of divisions from the coarse cells to the finest ones
  std::int64_t count = 0;  ///< 0: the surface has too many points for the page
};

/// Returns the finest drawing of at most `most_points` points. Subdivisions are tried from the degree down to one in
/// each cell. Then blocks of the smallest cells are tried, within one coarse cell. `cells_by_level`: number of cells
/// divided 0, 1, 2, ... times.
DrawnCells drawn_cells(fem::Shape shape, int degree, std::span<const std::int64_t> cells_by_level,
                       std::int64_t most_points);

struct SampledSurface {
  DrawnCells cells;
  std::int64_t points = 0;
  std::vector<Field> fields{};  ///< fields with a meaning here
  std::vector<std::vector<float>>
      rows{};  ///< a row for each component of each field, with a value for each point; on the first rank only
};

/// Returns the fields that colours can show: no tangents, no directions, no places except the mid-surface.
std::vector<Field> report_fields(bool has_obstacle, bool has_multiplier);

/// Returns the surface with cells in an order that does not depend on the number of ranks (collective). Throws the
/// errors of the chart at points between nodes, on all ranks together.
SampledSurface sampled_surface(const computation::Solution& solution, std::int64_t most_points);

}  // namespace plastron::io

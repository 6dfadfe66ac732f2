// The cells that a page draws: a lattice of points in each cell of the mesh, or in blocks of its cells. Values at the points of one
// mesh can be drawn on another mesh of the same sequence.
#pragma once
#include <plastron/fem/space.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace plastron::report {

/// Drawn cells, which may be blocks of the mesh's cells.
struct DrawnCells {
  int subdivisions = 1;  ///< lattice of points in each: mesh::lattice
  /// A drawn cell is a block of 2^merged_levels of the finest cells on each side, or one larger cell.
  int merged_levels = 0;
  int levels = 0;          ///< number of divisions from the coarse cells to the finest ones
  std::int64_t count = 0;  ///< 0: the surface has too many points for the page
};

/// Returns the finest drawing of at most `most_points` points. Subdivisions are tried from the degree down to one in
/// each cell. Then blocks of the smallest cells are tried, within one coarse cell. `cells_by_level`: number of cells
/// divided 0, 1, 2, ... times.
DrawnCells drawn_cells(mesh::Shape shape, int degree, std::span<const std::int64_t> cells_by_level,
                       std::int64_t most_points);

/// Place of a drawn cell in a cell of the first mesh, before any cuts: xi_first = corner + size xi.
struct DrawnPlace {
  std::size_t first = 0;
  Eigen::Vector2d corner{}, size{};
  bool operator==(const DrawnPlace&) const = default;
};

/// Drawn cells with their places, in the order of their points.
struct Drawing {
  mesh::Shape shape = mesh::Shape::quadrilateral;
  int subdivisions = 1;
  std::vector<DrawnPlace> places{};
  bool operator==(const Drawing&) const = default;
};

/// Returns rows of values at the points of one drawing at the points of another. Between its points values are linear, as the
/// page draws them.
std::vector<std::vector<float>> redrawn(const std::vector<std::vector<float>>& rows, const Drawing& from,
                                        const Drawing& to);

}  // namespace plastron::report

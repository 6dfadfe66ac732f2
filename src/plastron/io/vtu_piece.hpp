// Text of a .vtu file (VTK's XML format of unstructured grids): pieces of cells of one kind, with arrays compressed by
// zlib, in base64. deal.II also writes such files, but only in single precision and with its own patches as cells.
#pragma once
#include <plastron/io/atomic_file.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace plastron::io {

/// Numbers of points or cells, with the components of each together.
struct GridArray {
  std::string name, unit;
  int components = 1;
  std::vector<double> values{};
  bool are_integers = false;
};

/// VTK's numbers of cell types.
enum class CellType : std::uint8_t { hexahedron = 12, wedge = 13, lagrange_triangle = 69, lagrange_quadrilateral = 70 };

/// The part of one rank.
struct GridPiece {
  CellType type = CellType::hexahedron;
  std::size_t points_per_cell = 8;
  std::vector<double> points{};              ///< three coordinates each
  std::vector<std::int64_t> connectivity{};  ///< points of the piece, by cell, in VTK's order
  std::vector<GridArray> point_arrays{};
  std::vector<GridArray> cell_arrays{};
};

/// Adds a .vtu file of the pieces of all ranks; pieces without cells are omitted. Numbers are exact if `is_double`,
/// otherwise rounded to single precision (collective). Throws std::runtime_error.
void add_grid(const std::filesystem::path& path, const std::function<GridPiece()>& own_piece, bool is_double,
              AtomicFiles& files);

}  // namespace plastron::io

// The chords of a mesh of quadrilaterals: rows of cells that are neighbours across opposite sides. If all cells of a
// chord are divided along it, the mesh conforms without hanging nodes.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <array>
#include <vector>

namespace plastron::meshing {

struct Chords {
  /// Chords through each cell: the one across its direction xi_1, which cuts the sides xi_2 = 0 and 1, and the one
  /// across xi_2.
  std::vector<std::array<int, 2>> of_cell{};
  int count = 0;
};

/// Returns the chords, numbered by their first cells. Precondition: quadrilaterals. Their sides run the same way in
/// neighbours where this matters.
Chords chords(const fem::CoarseMesh& mesh);

}  // namespace plastron::meshing

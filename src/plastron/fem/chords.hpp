// The chords of a mesh of quadrilaterals: cells one beside the other across sides that lie opposite in each. A mesh in which all cells of
// a chord are divided along it conforms without hanging nodes.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <array>
#include <vector>

namespace plastron::fem {

struct Chords {
  /// Of each cell: the chord that goes through it across its direction xi_1 (its sides xi_2 = 0 and 1 are cut when it is divided), and the
  /// one across xi_2.
  std::vector<std::array<int, 2>> of_cell{};
  int count = 0;
};

/// Numbered by their first cells. Precondition: quadrilaterals, whose sides run the same way in neighbours where that matters.
Chords chords(const CoarseMesh& mesh);

}  // namespace plastron::fem

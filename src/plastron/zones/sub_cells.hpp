// Sub-cells: a cell of degree k is divided into k^2 sub-cells with nodes at their corners. Each side is shared with a
// neighbour.
#pragma once
#include <plastron/fem/reference_cell.hpp>

#include <array>
#include <vector>

namespace plastron::zones {

/// Three or four nodes of the cell in their order round a sub-cell.
using SubCell = std::vector<int>;

std::vector<SubCell> sub_cells(fem::Shape shape, int degree);

}  // namespace plastron::zones

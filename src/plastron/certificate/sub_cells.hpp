// A cell of degree k seen through its nodes: k^2 sub-cells with nodes at their corners, each side of them shared with a neighbour.
#pragma once
#include <plastron/fem/reference_cell.hpp>

#include <array>
#include <vector>

namespace plastron::certificate {

/// Three or four nodes of the cell as they follow each other round a sub-cell.
using SubCell = std::vector<int>;

std::vector<SubCell> sub_cells(fem::Shape shape, int degree);

}  // namespace plastron::certificate

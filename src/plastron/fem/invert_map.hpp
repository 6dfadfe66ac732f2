// The inverse of a cell's map: the point of the reference cell for a given point of the plane.
#pragma once
#include <plastron/fem/cell_map.hpp>
#include <plastron/fem/reference_cell.hpp>

#include <optional>

namespace plastron::fem {

/// Finds the point by Newton's method from the centre. Empty if the point lies outside the cell by more than
/// rounding.
std::optional<Vector2d> invert_map(Shape shape, const CellMap& map, const Vector2d& point);

}  // namespace plastron::fem

// The point of the reference cell that a map carries to a given point of the plane.
#pragma once
#include <plastron/fem/cell_map.hpp>
#include <plastron/fem/reference_cell.hpp>

#include <optional>

namespace plastron::fem {

/// By Newton's method from the centre; empty if the point lies outside of the cell by more than rounding.
std::optional<Vector2d> invert_map(Shape shape, const CellMap& map, const Vector2d& point);

}  // namespace plastron::fem

// The least gap anywhere in a cell, from gaps at points (docs/methods/admissible.md).
#pragma once
#include <plastron/mesh/reference_cell.hpp>

#include <functional>
#include <span>
#include <vector>

namespace plastron::fem {

/// Returns the least value found in a reference cell. Parts that may hold a value below it, by more than `tolerance` and a
/// hundredth of it, are divided, up to a limit. `intervals` of the first lattice per side: a multiple of 4.
double least_in_cell(mesh::Shape shape, int intervals, double tolerance,
                     const std::function<std::vector<double>(std::span<const mesh::Vector2d>)>& values);

}  // namespace plastron::fem

// A point of Omega in the cell that contains it.
#pragma once
#include <plastron/fem/space.hpp>

#include <optional>

namespace plastron::fem {

struct CellPoint {
  std::size_t cell;
  Vector2d xi;
};

/// Returns the point on the lowest rank that has a cell with it, nothing on the others (collective). Precondition: the point
/// lies in Omega.
std::optional<CellPoint> cell_point(const Space& space, const Vector2d& at);

}  // namespace plastron::fem

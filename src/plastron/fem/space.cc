#include <plastron/fem/space.hpp>

#include <cmath>

namespace plastron::fem {

CellPlace place_of(const Cell& cell) {
  const auto divisions = static_cast<std::int32_t>(std::lround(1 / cell.size));
  const auto in_parts = [&](double x) { return static_cast<std::int32_t>(std::lround(x * std::abs(divisions))); };
  return {cell.coarse, divisions, in_parts(cell.corner[0]), in_parts(cell.corner[1])};
}

}  // namespace plastron::fem

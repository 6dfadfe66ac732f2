// An order of places and sizes that rounding does not change. They are compared as multiples of a small unit, so that
// symmetric solutions give the same order on any number of ranks.
#pragma once
#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdint>

namespace plastron::solution {

/// A power of two: even divisions of a mesh lie on multiples and not halfway between them.
constexpr double units_per_whole = 1 << 28;

inline std::int64_t in_units(double value, double whole) {
  return whole > 0 && std::isfinite(value / whole) ? std::llround(value / whole * units_per_whole) : 0;
}
/// `size`: size of the object that contains the places [m].
inline std::array<std::int64_t, 3> in_units(const Eigen::Vector3d& place, double size) {
  return {in_units(place[0], size), in_units(place[1], size), in_units(place[2], size)};
}

}  // namespace plastron::solution

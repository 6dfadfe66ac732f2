// A rigid cone, infinite or with a plane base. Its tip and the edge of its base are rounded.
#pragma once
#include <plastron/obstacle/nearest.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace plastron::obstacle {

struct Cone {
  Vector3d apex = Vector3d::Zero();   ///< apex of the sharp cone [m]
  Vector3d axis = Vector3d::UnitZ();  ///< unit vector from the apex into the body
  /// Angle between axis and side, above 0 and below pi/2 [rad].
  double half_angle = std::numbers::pi / 4;
  /// Distance from the apex of the sharp cone to the base [m].
  double height = std::numeric_limits<double>::infinity();
  double fillet = 0;  ///< radius of the rounding, below largest_fillet() [m]

  /// Radius of the ball that touches side and base from within: h sin a / (1 + sin a).
  double largest_fillet() const;

  /// The body contains all points within `fillet` of a smaller sharp cone. On the axis inside the body no direction
  /// is nearest, and the normal is an arbitrary one of the nearest.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const {
    if (!std::isfinite(height)) return {};
    return extent_around(apex, extent_margin * height / std::cos(half_angle));
  }
};

}  // namespace plastron::obstacle

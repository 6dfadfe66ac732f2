// A rigid cone, infinite or with a plane base, its tip and the edge of its base rounded.
#pragma once
#include <plastron/obstacle/nearest.hpp>

#include <limits>
#include <numbers>

namespace plastron::obstacle {

struct Cone {
  Vector3d apex = Vector3d::Zero();                         ///< of the sharp cone [m]
  Vector3d axis = Vector3d::UnitZ();                        ///< unit vector from the apex into the body
  double half_angle = std::numbers::pi / 4;                 ///< between axis and side, above 0 and below pi/2 [rad]
  double height = std::numeric_limits<double>::infinity();  ///< from the apex of the sharp cone to the base [m]
  double fillet = 0;                                        ///< radius of the rounding, below largest_fillet() [m]

  /// The ball that touches side and base from within has this radius: h sin a / (1 + sin a).
  double largest_fillet() const;

  /// The body is all that is within `fillet` of a smaller sharp cone. On the axis within the body, where no direction is nearest, the
  /// normal is any of them.
  Nearest nearest(const Vector3d& X) const;
};

}  // namespace plastron::obstacle

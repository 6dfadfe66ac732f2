// A rigid torus: all points within `tube_radius` of a circle.
#pragma once
#include <plastron/obstacle/nearest.hpp>

namespace plastron::obstacle {

struct Torus {
  Vector3d centre = Vector3d::Zero();  ///< centre of the circle [m]
  Vector3d axis = Vector3d::UnitZ();   ///< unit vector normal to the circle's plane
  double radius = 1;                   ///< radius of the circle, > tube_radius [m]
  double tube_radius = 0.25;           ///< > 0 [m]

  /// The distance is not differentiable on the axis and on the circle; there the normal is an arbitrary one of the
  /// nearest.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const { return extent_around(centre, extent_margin * (radius + tube_radius)); }
};

}  // namespace plastron::obstacle

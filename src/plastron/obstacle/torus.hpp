// A rigid torus: all points within `tube_radius` of a circle.
#pragma once
#include <plastron/obstacle/nearest.hpp>

namespace plastron::obstacle {

struct Torus {
  Vector3d centre = Vector3d::Zero();  ///< of the circle [m]
  Vector3d axis = Vector3d::UnitZ();   ///< unit vector across the circle's plane
  double radius = 1;                   ///< of the circle, > tube_radius [m]
  double tube_radius = 0.25;           ///< > 0 [m]

  /// Not differentiable on the axis and on the circle, where the normal is any nearest one.
  Nearest nearest(const Vector3d& X) const;
};

}  // namespace plastron::obstacle

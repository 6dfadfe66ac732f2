// A rigid cylinder, infinite or with plane caps and rounded edges, or the complement of a cylinder (a tube that
// contains the shell).
#pragma once
#include <plastron/obstacle/nearest.hpp>

#include <cmath>
#include <limits>

namespace plastron::obstacle {

struct Cylinder {
  /// Point of the axis, its middle if the length is finite [m].
  Vector3d point = Vector3d::Zero();
  Vector3d axis = Vector3d::UnitZ();                        ///< unit vector
  double radius = 1;                                        ///< > 0 [m]
  double length = std::numeric_limits<double>::infinity();  ///< > 0 [m]
  bool inside = false;                                      ///< the shell is inside: the free side is the cylinder
  double fillet = 0;  ///< radius of the rounded edges of the caps, at most radius and length / 2 [m]

  /// The body contains all points within `fillet` of a sharp cylinder: d = (distance to the sharp one) - fillet, also
  /// inside. On the axis no direction is nearest, and the normal is an arbitrary one across the axis.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const {
    if (!std::isfinite(length)) return {};
    return extent_around(point, extent_margin * std::hypot(length / 2, radius));
  }
};

}  // namespace plastron::obstacle

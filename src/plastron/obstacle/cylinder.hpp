// A rigid cylinder, infinite or with plane caps and rounded edges, or all of space but that (a tube that holds the shell).
#pragma once
#include <plastron/obstacle/nearest.hpp>

#include <limits>

namespace plastron::obstacle {

struct Cylinder {
  Vector3d point = Vector3d::Zero();                        ///< of the axis, its middle if it has a length [m]
  Vector3d axis = Vector3d::UnitZ();                        ///< unit vector
  double radius = 1;                                        ///< > 0 [m]
  double length = std::numeric_limits<double>::infinity();  ///< > 0 [m]
  bool inside = false;                                      ///< the shell is inside: the free side is the cylinder
  double fillet = 0;  ///< radius of the rounded edges of the caps, at most radius and length / 2 [m]

  /// The body is all that is within `fillet` of a sharp cylinder, so that d = (distance to the sharp one) - fillet, inside too. On the
  /// axis, where no direction is nearest, the normal is any across it.
  Nearest nearest(const Vector3d& X) const;
};

}  // namespace plastron::obstacle

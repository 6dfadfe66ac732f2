// A rigid cylinder, infinite or with plane caps and rounded edges, or all of space but that (a tube that holds the shell).
#pragma once
#include <plastron/obstacle/revolution.hpp>

#include <algorithm>
#include <cmath>
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
  /// axis,
  /// where no direction is nearest, the normal is any across it.
  Nearest nearest(const Vector3d& X) const {
    const Nearest outside = revolved({point, axis}, X, [&](const Vector2d& at) { return profile(at); });
    return inside ? reversed(outside) : outside;
  }

 private:
  ProfileDistance profile(const Vector2d& at) const {
    const double side = at[1] < 0 ? -1 : 1, core_radius = radius - fillet, core_half = length / 2 - fillet;
    const Vector2d over(at[0] - core_radius, side * at[1] - core_half);
    const Vector2d up(0, side), out(1, 0);
    if (over[0] >= 0 && over[1] >= 0) {
      ProfileDistance corner = distance_to_point({over[0], side * over[1]});
      corner.distance -= fillet;
      return corner;
    }
    return over[0] >= over[1] ? distance_to_line(at[0] - radius, out) : distance_to_line(side * at[1] - length / 2, up);
  }
};

}  // namespace plastron::obstacle

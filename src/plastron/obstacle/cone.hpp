// A rigid cone, infinite or with a plane base, its tip and the edge of its base rounded.
#pragma once
#include <plastron/obstacle/revolution.hpp>

#include <cmath>
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
  double largest_fillet() const {
    const double s = std::sin(half_angle);
    return height / (1 / s + 1);
  }

  /// The body is all that is within `fillet` of a smaller sharp cone. On the axis within the body, where no direction is nearest, the
  /// normal
  /// is any of them.
  Nearest nearest(const Vector3d& X) const {
    const double s = std::sin(half_angle);
    return revolved({apex + fillet / s * axis, axis}, X, [&](const Vector2d& at) {
      ProfileDistance d = core_distance(at, height - fillet / s - fillet);
      d.distance -= fillet;
      return d;
    });
  }

 private:
  /// `along` runs down the side from the tip, `off` is the distance to the side's line.
  ProfileDistance core_distance(const Vector2d& at, double core_height) const {
    const double s = std::sin(half_angle), c = std::cos(half_angle);
    const double along = at[0] * s + at[1] * c, off = at[0] * c - at[1] * s, below = at[1] - core_height;
    const Vector2d edge(core_height * (s / c), core_height);
    ProfileDistance side = distance_to_line(off, {c, -s}), base = distance_to_line(below, {0, 1});
    if (off <= 0 && below <= 0) return off >= below ? side : base;
    if (along <= 0) return distance_to_point(at);
    if (off > 0 && along <= core_height / c) return side;
    return at[0] <= edge[0] ? base : distance_to_point(at - edge);
  }
};

}  // namespace plastron::obstacle

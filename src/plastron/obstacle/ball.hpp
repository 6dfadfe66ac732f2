// A rigid ball, or the complement of a ball (a bowl that contains the shell).
#pragma once
#include <plastron/obstacle/nearest.hpp>

namespace plastron::obstacle {

struct Ball {
  Vector3d centre = Vector3d::Zero();  ///< [m]
  double radius = 1;                   ///< > 0 [m]
  bool inside = false;                 ///< the shell is inside: the free side is the ball

  /// Returns distance and derivatives. The distance is not differentiable at the centre; there the normal is e_3.
  Nearest nearest(const Vector3d& X) const {
    const Vector3d from_centre = X - centre;
    const double length = from_centre.stableNorm(), side = inside ? -1 : 1;
    const Vector3d n = length > 0 ? Vector3d(from_centre / length) : Vector3d::UnitZ();
    const Matrix3d bend = length > 0 ? Matrix3d((Matrix3d::Identity() - n * n.transpose()) / length) : Matrix3d::Zero();
    return {side * (length - radius), side * n, side * bend};
  }
  std::optional<Extent> extent() const { return extent_around(centre, extent_margin * radius); }
};

}  // namespace plastron::obstacle

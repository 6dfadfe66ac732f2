// A rigid ball, or the complement of a ball (a bowl that contains the shell).
#pragma once
#include <plastron/obstacle/nearest.hpp>

namespace plastron::obstacle {

struct Ball {
  Vector3d centre = Vector3d::Zero();  ///< [m]
  double radius = 1;                   ///< > 0 [m]
  bool inside = false;                 ///< the shell is inside: the free side is the ball

  /// Returns distance and derivatives. The distance is not differentiable at the centre; there the normal is e_3.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const;
};

}  // namespace plastron::obstacle

#include <plastron/obstacle/ball.hpp>

namespace plastron::obstacle {

Nearest Ball::nearest(const Vector3d& X) const {
  const Vector3d from_centre = X - centre;
  const double length = from_centre.stableNorm(), side = inside ? -1 : 1;
  const Vector3d n = length > 0 ? Vector3d(from_centre / length) : Vector3d::UnitZ();
  const Matrix3d bend = length > 0 ? Matrix3d((Matrix3d::Identity() - n * n.transpose()) / length) : Matrix3d::Zero();
  return {side * (length - radius), side * n, side * bend};
}

std::optional<Extent> Ball::extent() const { return extent_around(centre, extent_margin * radius); }

}  // namespace plastron::obstacle

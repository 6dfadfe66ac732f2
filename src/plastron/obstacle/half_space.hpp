// A rigid half-space { (X - point) . normal <= 0 }: the obstacle of the paper for point 0, normal e_3.
#pragma once
#include <plastron/obstacle/nearest.hpp>

namespace plastron::obstacle {

struct HalfSpace {
  Vector3d point = Vector3d::Zero();    ///< a point of the boundary plane [m]
  Vector3d normal = Vector3d::UnitZ();  ///< unit vector towards the free side

  Nearest nearest(const Vector3d& X) const { return {(X - point).dot(normal), normal, Matrix3d::Zero()}; }
  std::optional<Extent> extent() const { return {}; }
};

}  // namespace plastron::obstacle

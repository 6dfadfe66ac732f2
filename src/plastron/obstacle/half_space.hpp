// A rigid half-space { (X - point) . normal <= 0 }: the obstacle of the paper for point 0, normal e_3.
#pragma once
#include <plastron/geometry/jet.hpp>

namespace plastron::obstacle {

using geometry::Vector3d;

struct HalfSpace {
  Vector3d point = Vector3d::Zero();    ///< a point of the boundary plane [m]
  Vector3d normal = Vector3d::UnitZ();  ///< unit vector to the free side

  /// Signed distance d(X), positive on the free side [m].
  double distance(const Vector3d& X) const { return (X - point).dot(normal); }
  /// grad d(X).
  Vector3d gradient(const Vector3d& /*X*/) const { return normal; }
};

}  // namespace plastron::obstacle

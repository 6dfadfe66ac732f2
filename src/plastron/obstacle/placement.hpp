// The place of a body at rest: its own coordinates rotated about a point, then translated.
#pragma once
#include <plastron/obstacle/nearest.hpp>

namespace plastron::obstacle {

/// Placement of a body: the point x of its own coordinates is at rotation x + translation in space.
struct Placement {
  Matrix3d rotation = Matrix3d::Identity();
  Vector3d translation = Vector3d::Zero();  ///< [m]

  Vector3d to_body(const Vector3d& X) const { return rotation.transpose() * (X - translation); }
  Vector3d to_space(const Vector3d& x) const { return rotation * x + translation; }
  /// Distances are unchanged, directions are rotated.
  Nearest to_space(const Nearest& of_body) const {
    return {of_body.distance, rotation * of_body.normal, rotation * of_body.curvature * rotation.transpose()};
  }
};

/// Applies `first`, then `then`.
inline Placement operator*(const Placement& then, const Placement& first) {
  return {then.rotation * first.rotation, then.to_space(first.translation)};
}

/// Rotates by `angle` [rad] about the line through `about` along the unit vector `axis` by the right-hand rule, then
/// translates by `translation`.
Placement placed(const Vector3d& axis, double angle, const Vector3d& about, const Vector3d& translation);

}  // namespace plastron::obstacle

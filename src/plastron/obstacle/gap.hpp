// The gap of a face of the shell against an obstacle, as an affine function of (u, r) at a point (M16).
#pragma once
#include <plastron/obstacle/obstacle.hpp>

namespace plastron::obstacle {

/// Height of a face over the mid-surface as a multiple of the thickness: -1/2 or +1/2.
inline double face_position(Face face) { return face == Face::lower ? -0.5 : 0.5; }

/// g(u, r) = initial + n . (u + z r), with z = -e/2 (lower face) or +e/2 (upper face).
struct Gap {
  double initial;          ///< gap of the undeformed shell [m]
  Vector3d normal;         ///< n = grad d at the touching face
  double z;                ///< height of the touching face over the mid-surface [m]
  Vector3d contact_point;  ///< phi + z a_3

  double operator()(const Vector3d& u, const Vector3d& r) const { return initial + normal.dot(u + z * r); }
};

/// Linearised at the face of the undeformed shell, the obstacle standing where it does at `time`.
inline Gap gap_at(const Obstacle& obstacle, const Vector3d& phi, const Vector3d& a3, double thickness,
                  double time = 0) {
  const double z = face_position(obstacle.face) * thickness;
  const Vector3d point = phi + z * a3;
  const Nearest nearest = obstacle.nearest(point, time);
  return {nearest.distance, nearest.normal, z, point};
}

}  // namespace plastron::obstacle

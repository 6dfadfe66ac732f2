// The gap of a face of the shell against an obstacle, as an affine function of (u, r) at a point (M16).
#pragma once
#include <plastron/obstacle/obstacle.hpp>

namespace plastron::obstacle {

/// Height of a face over the mid-surface as a multiple of the thickness, -1/2 or +1/2, where the obstacle's normal is n.
inline double face_position(Face face, const Vector3d& n, const Vector3d& a3) {
  if (face == Face::nearer) return n.dot(a3) >= 0 ? -0.5 : 0.5;
  return face == Face::lower ? -0.5 : 0.5;
}

/// g(u, r) = initial + n . (u + z r), with z = -e/2 (lower face) or +e/2 (upper face).
struct Gap {
  double initial;          ///< gap of the undeformed shell [m]
  Vector3d normal;         ///< n = grad d at the touching face
  double z;                ///< height of the touching face over the mid-surface [m]
  Vector3d contact_point;  ///< phi + z a_3

  double operator()(const Vector3d& u, const Vector3d& r) const { return initial + normal.dot(u + z * r); }
};

/// A point of the mid-surface, and where the state has moved it that the gap is linearised at.
struct ShellPoint {
  Vector3d phi, a3;
  double thickness = 0;
  Vector3d u = Vector3d::Zero();  ///< displacement of the state [m]
  Vector3d r = Vector3d::Zero();  ///< rotation of the state, tangential
};

/// (M16) linearised at the face where the state has moved it: there the gap is the true distance. At the undeformed shell the linearisation of the model, exact for planes at every state.
inline Gap gap_at(const Obstacle& obstacle, const ShellPoint& at) {
  const Vector3d n = obstacle.face == Face::nearer ? obstacle.nearest(at.phi + at.u).normal : Vector3d::Zero();
  const double z = face_position(obstacle.face, n, at.a3) * at.thickness;
  const Vector3d point = at.phi + z * at.a3, moved = at.u + z * at.r;
  const Nearest nearest = obstacle.nearest(point + moved);
  return {nearest.distance - nearest.normal.dot(moved), nearest.normal, z, point};
}

/// The distance of the touching face of the deformed shell, not linearised [m]; `at` has the displacement.
inline double true_gap(const Obstacle& obstacle, const Gap& gap, const ShellPoint& at) {
  return obstacle.nearest(gap.contact_point + at.u + gap.z * at.r).distance;
}

}  // namespace plastron::obstacle

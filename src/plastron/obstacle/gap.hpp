// The gap of a face of the shell against an obstacle, as an affine function of (u, r) at a point (M16).
#pragma once
#include <plastron/obstacle/obstacle.hpp>

#include <limits>

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

/// How the face at a point of the deformed shell stands to an obstacle. The obstacle may be smaller than the shell is thick: the straight
/// line from the mid-surface to the face, half a fibre, tells on which side of the obstacle the face belongs
/// (docs/methods/curved-obstacles.md).
struct FaceGap {
  double z = 0;                         ///< height of the face over the mid-surface [m]
  double distance = 0;                  ///< to the obstacle, negative where the half fibre enters it [m]
  Vector3d normal = Vector3d::UnitZ();  ///< of the obstacle where the face meets it
  /// No point of the half fibre is nearer to the obstacle, if that is convex; at most 0 where one is inside [m].
  double clearance = 0;
  /// Radius of the obstacle's sharpest rounding where it is nearest, at most 0 at an edge or a corner [m].
  double roundness = std::numeric_limits<double>::infinity();
};
FaceGap face_gap(const Obstacle& obstacle, const ShellPoint& at);

/// The straight way of a point of the mid-surface, seen from the obstacle.
struct Passage {
  double clearance = std::numeric_limits<
      double>::infinity();  ///< no place of the way is nearer to the obstacle, if it changes sides [m]
  bool is_through = false;  ///< the way leads through the obstacle from one side of the shell to the other
};
/// `normal` is the shell's: an obstacle changes sides where it looks at one face first and at the other one then.
Passage passage(const Obstacle& obstacle, const Vector3d& from, const Vector3d& to, const Vector3d& normal);

/// (M16) linearised at the face where the state has moved it: there the gap is that of face_gap(). At the undeformed shell
/// the linearisation of the model, exact for planes at every state.
Gap gap_at(const Obstacle& obstacle, const ShellPoint& at);

/// The distance of the touching face of the deformed shell, not linearised [m]; `at` has the displacement.
double true_gap(const Obstacle& obstacle, const Gap& gap, const ShellPoint& at);

}  // namespace plastron::obstacle

// The gap of a face of the shell to an obstacle, as an affine function of (u, r) at a point (M16).
#pragma once
#include <plastron/obstacle/obstacle.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace plastron::obstacle {

/// Height of a face above the mid-surface as a multiple of the thickness, -1/2 or +1/2, for the obstacle's normal n.
inline double face_position(Face face, const Vector3d& n, const Vector3d& a3) {
  if (face == Face::nearer) return n.dot(a3) >= 0 ? -0.5 : 0.5;
  return face == Face::lower ? -0.5 : 0.5;
}

/// g(u, r) = initial + n . (u + arm r). The arm is z = -e/2 (lower face) or +e/2 (upper face). At a fold it
/// is 0: all faces move with u alone.
struct Gap {
  double initial;          ///< gap of the undeformed shell [m]
  Vector3d normal;         ///< n = grad d at the touching face
  double z;                ///< height of the touching face above the mid-surface [m]
  Vector3d contact_point;  ///< phi + z a_3
  double arm = z;          ///< z, or 0 at a fold [m]

  double operator()(const Vector3d& u, const Vector3d& r) const { return initial + normal.dot(u + arm * r); }
};

/// The part of the shell that a node represents: the distance of the nearest node in each direction of the plane across a_3, in
/// parts of 45 degrees from a_3.unitOrthogonal(). 0 beyond an edge of the shell [m].
using Reach = std::array<double, 8>;
/// Returns the index of a direction in a reach.
std::size_t reach_direction(const Vector3d& a3, const Vector3d& way);

/// A point of the mid-surface with its displacement and rotation in the state of the linearisation.
struct ShellPoint {
  Vector3d phi, a3;
  double thickness = 0;
  Vector3d u = Vector3d::Zero();  ///< displacement of the state [m]
  Vector3d r = Vector3d::Zero();  ///< rotation of the state, tangential
  bool is_turned = false;  ///< finite rotations: a_3 + r is the director, and not a_3, decides which face is nearer
};

/// The relation of a face of the deformed shell at a point to an obstacle. The obstacle may be smaller than the
/// shell's thickness. Therefore the straight line from the mid-surface to the face, half a fibre, determines the side
/// of the obstacle to which the face belongs (docs/methods/curved-obstacles.md).
struct FaceGap {
  double z = 0;                         ///< height of the face above the mid-surface [m]
  double distance = 0;                  ///< distance to the obstacle, negative if the half fibre enters it [m]
  Vector3d normal = Vector3d::UnitZ();  ///< normal of the obstacle where the face meets it
  /// Lower bound of the distance from the half fibre to a convex obstacle; at most 0 if a point is inside [m].
  double clearance = 0;
  /// Radius of the sharpest rounding at the obstacle's nearest point, at most 0 at an edge or a corner [m].
  double roundness = std::numeric_limits<double>::infinity();
};
FaceGap face_gap(const Obstacle& obstacle, const ShellPoint& at);
/// Prepares the obstacle for face_gap() and gap_at() at many points.
void prepare_gaps(const Obstacle& obstacle, std::span<const ShellPoint> points);

/// The gap (M16), linearised at the face in its present state, where it equals face_gap(). At the undeformed shell it
/// is the linearisation of the model; for planes it is exact at every state.
Gap gap_at(const Obstacle& obstacle, const ShellPoint& at);
/// The same for a node. Its face may lie on sharp edges and corners of the obstacle, and is pushed there along its own normal.
Gap gap_at(const Obstacle& obstacle, const ShellPoint& at, const Reach& reach);

/// The distance of the touching face of the deformed shell without linearisation [m]; `at` contains the displacement.
double true_gap(const Obstacle& obstacle, const Gap& gap, const ShellPoint& at);
double true_gap(const Obstacle& obstacle, const Gap& gap, const ShellPoint& at, const Reach& reach);

}  // namespace plastron::obstacle

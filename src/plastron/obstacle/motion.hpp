// The place of a body, its own coordinates rotated about a point and then translated; and its motion through the steps of
// a computation.
#pragma once
#include <plastron/obstacle/nearest.hpp>

#include <vector>

namespace plastron::obstacle {

/// Placement of a body: the point x of its own coordinates is at rotation x + translation in space.
struct Placement {
  Matrix3d rotation = Matrix3d::Identity();
  Vector3d translation = Vector3d::Zero();  ///< [m]

  Vector3d to_body(const Vector3d& X) const;
  Vector3d to_space(const Vector3d& x) const;
  /// Distances are unchanged, directions are rotated.
  Nearest to_space(const Nearest& of_body) const;
};

/// Applies `first`, then `then`.
Placement operator*(const Placement& then, const Placement& first);

/// Rotates by `angle` [rad] about the line through `about` along the unit vector `axis` by the right-hand rule, then
/// translates by `translation`.
Placement placed(const Vector3d& axis, double angle, const Vector3d& about, const Vector3d& translation);

/// Motion of a body in one step: a rotation about a line of space and a translation. Both are proportional to the
/// elapsed part of the step.
struct Motion {
  Vector3d axis = Vector3d::UnitZ();        ///< direction of the line, a unit vector
  double angle = 0;                         ///< angle by the right-hand rule over the whole step [rad]
  Vector3d about = Vector3d::Zero();        ///< a point of the line
  Vector3d translation = Vector3d::Zero();  ///< translation over the whole step [m]

  Placement after(double part) const;
};

/// Placement at `time` of a body with the placement `start` at time 0. Motion k runs from time k to k + 1; after the
/// last one the body rests.
Placement moved(Placement start, const std::vector<Motion>& motions, double time);

}  // namespace plastron::obstacle

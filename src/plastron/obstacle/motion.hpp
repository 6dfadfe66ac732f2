// Motion of a body through the steps of a computation.
#pragma once
#include <plastron/obstacle/placement.hpp>

#include <vector>

namespace plastron::obstacle {

/// Motion of a body in one step: a rotation about a line of space and a translation. Both are proportional to the
/// elapsed part of the step.
struct Motion {
  Vector3d axis = Vector3d::UnitZ();        ///< direction of the line, a unit vector
  double angle = 0;                         ///< angle by the right-hand rule over the whole step [rad]
  Vector3d about = Vector3d::Zero();        ///< a point of the line
  Vector3d translation = Vector3d::Zero();  ///< translation over the whole step [m]

  Placement after(double part) const { return placed(axis, part * angle, about, part * translation); }
};

/// Placement at `time` of a body with the placement `start` at time 0. Motion k runs from time k to k + 1; after the
/// last one the body rests.
Placement moved(Placement start, const std::vector<Motion>& motions, double time);

}  // namespace plastron::obstacle

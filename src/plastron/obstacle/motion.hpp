// How a body moves through the steps of a computation.
#pragma once
#include <plastron/obstacle/placement.hpp>

#include <vector>

namespace plastron::obstacle {

/// What a body does in one step: it turns about a line of space and shifts, both in proportion to the part of the step that is over.
struct Motion {
  Vector3d axis = Vector3d::UnitZ();        ///< direction of the line, a unit vector
  double angle = 0;                         ///< by the right hand, over the whole step [rad]
  Vector3d about = Vector3d::Zero();        ///< a point of the line
  Vector3d translation = Vector3d::Zero();  ///< over the whole step [m]

  Placement after(double part) const { return placed(axis, part * angle, about, part * translation); }
};

/// Where a body that stood at `start` at time 0 stands when the motions have run to `time`: motion k runs from time k to k + 1, and
/// after the last the body rests.
Placement moved(Placement start, const std::vector<Motion>& motions, double time);

}  // namespace plastron::obstacle

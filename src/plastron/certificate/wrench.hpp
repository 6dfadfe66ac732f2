// A system of forces, reduced to the origin.
#pragma once
#include <Eigen/Core>

namespace plastron::certificate {

using Eigen::Vector3d;

/// Resultant [N] and moment about the origin [N m].
struct Wrench {
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();
};

}  // namespace plastron::certificate

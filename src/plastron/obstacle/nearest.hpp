// Values of an obstacle at a point X of space: its signed distance d(X) and the first two derivatives.
#pragma once
#include <plastron/geometry/jet.hpp>

namespace plastron::obstacle {

using Eigen::Matrix3d;
using geometry::Vector3d;

struct Nearest {
  double distance;     ///< d, positive on the free side [m]
  Vector3d normal;     ///< grad d, a unit vector towards the free side
  Matrix3d curvature;  ///< Hessian of d: the curvature of the surface of equal distance through X [1/m]
};

/// The values of the same surface with the other side free.
inline Nearest reversed(const Nearest& other) { return {-other.distance, -other.normal, -other.curvature}; }

}  // namespace plastron::obstacle

// What an obstacle answers at a point X of space: its signed distance d(X) and the first two derivatives.
#pragma once
#include <plastron/geometry/jet.hpp>

namespace plastron::obstacle {

using Eigen::Matrix3d;
using geometry::Vector3d;

struct Nearest {
  double distance;     ///< d, positive on the free side [m]
  Vector3d normal;     ///< grad d, a unit vector to the free side
  Matrix3d curvature;  ///< Hessian of d: the curvature of the surface of equal distance through X [1/m]
};

/// The same surface seen from its other side.
inline Nearest reversed(const Nearest& other) { return {-other.distance, -other.normal, -other.curvature}; }

}  // namespace plastron::obstacle

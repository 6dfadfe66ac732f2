// Each shape of obstacle has two functions: nearest(X) returns its signed distance d(X) with the first two derivatives,
// extent() returns a box around its surface.
#pragma once
#include <plastron/geometry/jet.hpp>

#include <Eigen/Core>
#include <optional>

namespace plastron::obstacle {

using Eigen::Matrix3d;
using geometry::Vector3d;

struct Nearest {
  double distance;     ///< d, positive on the free side [m]
  Vector3d normal;     ///< grad d, a unit vector towards the free side
  Matrix3d curvature;  ///< Hessian of d: the curvature of the surface of equal distance through X [1/m]
};

/// Radius of the sharpest rounding at the surface's nearest point, at most 0 at an edge or a corner up to rounding [m].
double roundness(const Nearest& nearest);

/// The values of the same surface with the other side free.
Nearest reversed(const Nearest& other);

/// An axis-parallel box of space. The extent of a shape contains its surface with a small margin. A shape without bounds
/// has none.
struct Extent {
  Vector3d low, high;
};
inline constexpr double extent_margin = 1.01;  ///< factor by which an extent is larger than the surface
Extent extent_around(const Vector3d& centre, double reach);

/// Larger coordinates in files are refused, because computations would overflow.
inline constexpr double largest_coordinate = 1e50;

/// The Hessian of d on the surface F = 0: S = P F'' P / |F'|, with P = I - n n^T and n = F' / |F'|.
Matrix3d surface_curvature(const Vector3d& n, double gradient_size, const Matrix3d& hessian);

/// The Hessian at distance d from the surface, S (I + d S)^-1: radii of curvature grow by d. Zero where a radius
/// vanishes, because d has no second derivatives there.
Matrix3d offset_curvature(const Matrix3d& S, double d);

}  // namespace plastron::obstacle

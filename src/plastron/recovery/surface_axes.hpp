// Orthonormal axes of the tangent plane, in which tensors are given, and how tensors go from one tangent plane to another.
#pragma once
#include <plastron/geometry/frame.hpp>

#include <optional>

namespace plastron::recovery {

using geometry::Vector3d;

/// t1, t2 = a_3 x t1 and the unit normal a_3.
struct SurfaceAxes {
  Vector3d t1 = Vector3d::UnitX(), t2 = Vector3d::UnitY(), a3 = Vector3d::UnitZ();
};

/// Sine of the angle to the normal below which an axis has no direction in the tangent plane.
inline constexpr double parallel_sine = 1e-6;

/// t1 is the wanted axis projected on the surface; the tangent d phi/dx where there is none, or where it is normal to the surface.
inline SurfaceAxes surface_axes(const geometry::SurfaceJet& in_parameters, const Vector3d& a3,
                                const std::optional<Vector3d>& axis) {
  Vector3d t1 = in_parameters.d[0];
  if (axis) {
    const Vector3d projected = geometry::tangential(*axis, a3);
    if (projected.norm() > parallel_sine * axis->norm()) t1 = projected;
  }
  t1.normalize();
  return {t1, a3.cross(t1), a3};
}

/// The rotation that turns the normal `from` into `to` by the shortest way. Precondition: they are not opposite.
inline Eigen::Matrix3d shortest_turn(const Vector3d& from, const Vector3d& to) {
  const Vector3d w = from.cross(to);
  Eigen::Matrix3d cross;
  cross << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  return Eigen::Matrix3d::Identity() + cross + cross * cross / (1 + from.dot(to));
}

/// The rotation of the tangent plane that takes components in `from`, turned the shortest way into the plane of `to`, to components in `to`:
/// column vectors of the 2 x 2 matrix.
inline Eigen::Matrix2d change_of_axes(const SurfaceAxes& from, const SurfaceAxes& to) {
  const Eigen::Matrix3d turn = shortest_turn(from.a3, to.a3);
  const Vector3d t1 = turn * from.t1, t2 = turn * from.t2;
  Eigen::Matrix2d change;
  change << t1.dot(to.t1), t2.dot(to.t1), t1.dot(to.t2), t2.dot(to.t2);
  return change;
}

/// C T C' for a symmetric tensor in the order 11, 22, 12.
inline Vector3d in_other_axes(const Vector3d& tensor, const Eigen::Matrix2d& change) {
  Eigen::Matrix2d t;
  t << tensor[0], tensor[2], tensor[2], tensor[1];
  const Eigen::Matrix2d p = change * t * change.transpose();
  return {p(0, 0), p(1, 1), p(0, 1)};
}

}  // namespace plastron::recovery

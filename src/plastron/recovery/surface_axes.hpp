// Orthonormal axes of the tangent plane for components of tensors, and the transformation between tangent planes.
#pragma once
#include <plastron/geometry/frame.hpp>

#include <optional>

namespace plastron::recovery {

using geometry::Vector3d;

/// t1, t2 = a_3 x t1 and the unit normal a_3.
struct SurfaceAxes {
  Vector3d t1 = Vector3d::UnitX(), t2 = Vector3d::UnitY(), a3 = Vector3d::UnitZ();
};

/// Sine of the angle to the normal below which an axis counts as normal to the surface.
inline constexpr double parallel_sine = 1e-6;

/// Returns axes with t1 along the projection of `axis` on the surface. Without `axis`, or if it is normal to the
/// surface, t1 follows the tangent d phi/dx.
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

/// The smallest rotation that turns the normal `from` into `to`. Precondition: they are not opposite.
inline Eigen::Matrix3d shortest_turn(const Vector3d& from, const Vector3d& to) {
  const Vector3d w = from.cross(to);
  Eigen::Matrix3d cross;
  cross << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  return Eigen::Matrix3d::Identity() + cross + cross * cross / (1 + from.dot(to));
}

/// The 2 x 2 matrix that maps components in `from` to components in `to`, for column vectors. The axes `from` are
/// turned into the plane of `to` by the smallest rotation.
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

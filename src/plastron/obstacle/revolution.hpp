// Solids of revolution: converts a signed distance in the half-plane (rho, z) of an axis to a distance in space.
#pragma once
#include <plastron/obstacle/nearest.hpp>

namespace plastron::obstacle {

using geometry::Vector2d;

/// A line in space that defines the half-plane's coordinates: z along it, rho >= 0 away from it.
struct Axis {
  Vector3d point = Vector3d::Zero();       ///< point with z = 0 [m]
  Vector3d direction = Vector3d::UnitZ();  ///< unit vector
};

/// d(rho, z) with its derivatives.
struct ProfileDistance {
  double distance;            ///< positive outside of the body [m]
  Vector2d gradient;          ///< a unit vector
  Eigen::Matrix2d curvature;  ///< Hessian [1/m]
};

/// Distance to a point at the vector `from_centre`: the gradient is radial, the curvature 1/d across.
inline ProfileDistance distance_to_point(const Vector2d& from_centre) {
  const double length = from_centre.stableNorm();
  const Vector2d n = length > 0 ? Vector2d(from_centre / length) : Vector2d::UnitY();
  const Vector2d t(-n[1], n[0]);
  return {length, n, length > 0 ? Eigen::Matrix2d(t * t.transpose() / length) : Eigen::Matrix2d::Zero()};
}

/// Distance to a straight line whose unit normal is n.
inline ProfileDistance distance_to_line(double distance, const Vector2d& n) {
  return {distance, n, Eigen::Matrix2d::Zero()};
}

/// Returns values in space for d from profile(rho, z): grad d = d_rho e_rho + d_z e. The Hessian has the additional
/// term d_rho/rho around the axis, with the limit d_rho,rho on the axis where d is smooth. Where d is not smooth,
/// e_rho is an arbitrary direction across and d_rho/rho is omitted.
template <class Profile>
Nearest revolved(const Axis& axis, const Vector3d& X, const Profile& profile) {
  const Vector3d from_point = X - axis.point;
  const double z = from_point.dot(axis.direction);
  const Vector3d across = from_point - z * axis.direction;
  const double rho = across.stableNorm();
  const Vector3d e_rho = rho > 0 ? Vector3d(across / rho) : axis.direction.unitOrthogonal();
  const Vector3d e_phi = axis.direction.cross(e_rho);
  const ProfileDistance d = profile(Vector2d(rho, z));
  const double at_axis = d.gradient[0] == 0 ? d.curvature(0, 0) : 0;
  Eigen::Matrix<double, 3, 2> plane;
  plane << e_rho, axis.direction;
  return {d.distance, plane * d.gradient,
          plane * d.curvature * plane.transpose() +
              (rho > 0 ? d.gradient[0] / rho : at_axis) * (e_phi * e_phi.transpose())};
}

}  // namespace plastron::obstacle

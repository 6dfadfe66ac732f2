// Rotations as matrices and as vectors: axis times angle.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plastron::geometry {

/// Returns the matrix of the product v x.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

/// Returns axis times angle of a rotation, with an angle of at most pi [rad].
inline Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& turn) {
  const Eigen::AngleAxisd rotation(turn);
  return rotation.angle() * rotation.axis();
}

/// Returns the rotation of a vector: axis times angle [rad].
inline Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

}  // namespace plastron::geometry

// Rotations as matrices and as vectors: axis times angle.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

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

/// Returns the vector of a rotation that is nearest to another one; it can be longer than pi [rad].
inline Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& turn, const Eigen::Vector3d& near) {
  constexpr double whole_turn = 2 * std::numbers::pi, no_turn = 1e-8;
  const Eigen::AngleAxisd least(turn);
  const Eigen::Vector3d axis =
      least.angle() > no_turn || near.isZero(0) ? least.axis() : Eigen::Vector3d(near.normalized());
  return (least.angle() + whole_turn * std::round((near.dot(axis) - least.angle()) / whole_turn)) * axis;
}

/// Returns the rotation of a vector: axis times angle [rad].
inline Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

}  // namespace plastron::geometry

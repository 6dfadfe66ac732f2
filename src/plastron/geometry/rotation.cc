#include <plastron/geometry/rotation.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace plastron::geometry {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& turn) {
  const Eigen::AngleAxisd rotation(turn);
  return rotation.angle() * rotation.axis();
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& turn, const Eigen::Vector3d& near) {
  constexpr double whole_turn = 2 * std::numbers::pi, no_turn = 1e-8;
  const Eigen::AngleAxisd least(turn);
  const Eigen::Vector3d axis =
      least.angle() > no_turn || near.isZero(0) ? least.axis() : Eigen::Vector3d(near.normalized());
  return (least.angle() + whole_turn * std::round((near.dot(axis) - least.angle()) / whole_turn)) * axis;
}

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

}  // namespace plastron::geometry

#include <plastron/obstacle/motion.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace plastron::obstacle {

Vector3d Placement::to_body(const Vector3d& X) const { return rotation.transpose() * (X - translation); }

Vector3d Placement::to_space(const Vector3d& x) const { return rotation * x + translation; }

Nearest Placement::to_space(const Nearest& of_body) const {
  return {of_body.distance, rotation * of_body.normal, rotation * of_body.curvature * rotation.transpose()};
}

Placement operator*(const Placement& then, const Placement& first) {
  return {then.rotation * first.rotation, then.to_space(first.translation)};
}

Placement Motion::after(double part) const { return placed(axis, part * angle, about, part * translation); }

Placement placed(const Vector3d& axis, double angle, const Vector3d& about, const Vector3d& translation) {
  const Matrix3d rotation =
      angle == 0 ? Matrix3d(Matrix3d::Identity()) : Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return {rotation, angle == 0 ? translation : Vector3d(about - rotation * about + translation)};
}

Placement moved(Placement start, const std::vector<Motion>& motions, double time) {
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const double part = std::clamp(time - static_cast<double>(k), 0.0, 1.0);
    if (part > 0) start = motions[k].after(part) * start;
  }
  return start;
}

}  // namespace plastron::obstacle

#include <plastron/obstacle/box.hpp>

namespace plastron::obstacle {

Nearest Box::nearest(const Vector3d& X) const {
  const Vector3d at = axes.transpose() * (X - centre);
  const Vector3d side = at.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
  const Vector3d over_face = at.cwiseAbs() - size / 2;
  const Eigen::Array3d over_core = over_face.array() + fillet;
  const auto bends = (over_core > 0 || size.array() / 2 == fillet).eval();
  const Vector3d beyond = bends.select(over_core, 0);
  const double length = beyond.stableNorm();
  if (bends.count() < 2 || length == 0) {
    int face = 0;
    const double distance = over_face.maxCoeff(&face);
    return {distance, side[face] * axes.col(face), Matrix3d::Zero()};
  }
  const Vector3d n = beyond.cwiseProduct(side) / length;
  const Matrix3d bent = bends.cast<double>().matrix().asDiagonal();
  const Matrix3d curvature = (bent - n * n.transpose()) / length;
  return {length - fillet, axes * n, axes * curvature * axes.transpose()};
}

}  // namespace plastron::obstacle

// A rigid box, its edges and corners rounded.
#pragma once
#include <plastron/obstacle/nearest.hpp>

namespace plastron::obstacle {

struct Box {
  Vector3d centre = Vector3d::Zero();    ///< [m]
  Vector3d size = Vector3d::Ones();      ///< lengths of the sides, > 0 [m]
  Matrix3d axes = Matrix3d::Identity();  ///< columns: directions of the sides, orthonormal
  double fillet = 0;                     ///< radius of the rounding, at most half of the shortest side [m]

  /// The body is all that is within `fillet` of a smaller sharp box, the core. Where several faces are equally near inside, the first of
  /// them
  /// has the normal.
  Nearest nearest(const Vector3d& X) const {
    const Vector3d at = axes.transpose() * (X - centre);
    const Vector3d side = at.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
    const Vector3d over_face = at.cwiseAbs() - size / 2;
    const Eigen::Array3d over_core = over_face.array() + fillet;
    const auto bends = (over_core > 0 || size.array() / 2 == fillet).eval();
    const Vector3d beyond = bends.select(over_core, 0);
    const double length = beyond.stableNorm();
    if (bends.count() < 2 || length == 0) return nearest_face(over_face, side);
    const Vector3d n = beyond.cwiseProduct(side) / length;
    const Matrix3d bent = bends.cast<double>().matrix().asDiagonal();
    const Matrix3d curvature = (bent - n * n.transpose()) / length;
    return {length - fillet, axes * n, axes * curvature * axes.transpose()};
  }

 private:
  Nearest nearest_face(const Vector3d& over_face, const Vector3d& side) const {
    int face = 0;
    const double distance = over_face.maxCoeff(&face);
    return {distance, side[face] * axes.col(face), Matrix3d::Zero()};
  }
};

}  // namespace plastron::obstacle

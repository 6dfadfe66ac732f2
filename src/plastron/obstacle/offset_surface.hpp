// Second derivatives of the distance from a smooth surface, at points off the surface.
#pragma once
#include <plastron/obstacle/nearest.hpp>

#include <Eigen/LU>

namespace plastron::obstacle {

/// The Hessian of d on the surface F = 0: S = P F'' P / |F'|, with P = I - n n^T and n = F' / |F'|.
inline Matrix3d surface_curvature(const Vector3d& n, double gradient_size, const Matrix3d& hessian) {
  const Matrix3d P = Matrix3d::Identity() - n * n.transpose();
  return P * hessian * P / gradient_size;
}

/// The Hessian at distance d from the surface, S (I + d S)^-1: radii of curvature grow by d. Zero where a radius
/// vanishes, because d has no second derivatives there.
inline Matrix3d offset_curvature(const Matrix3d& S, double d) {
  const Matrix3d grown = Matrix3d::Identity() + d * S;
  if (!(grown.determinant() > 0)) return Matrix3d::Zero();
  const Matrix3d H = S * grown.inverse();
  return (H + H.transpose()) / 2;
}

}  // namespace plastron::obstacle

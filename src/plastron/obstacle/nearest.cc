#include <plastron/obstacle/nearest.hpp>

#include <Eigen/LU>

namespace plastron::obstacle {

Nearest reversed(const Nearest& other) { return {-other.distance, -other.normal, -other.curvature}; }

Extent extent_around(const Vector3d& centre, double reach) { return {centre.array() - reach, centre.array() + reach}; }

Matrix3d surface_curvature(const Vector3d& n, double gradient_size, const Matrix3d& hessian) {
  const Matrix3d P = Matrix3d::Identity() - n * n.transpose();
  return P * hessian * P / gradient_size;
}

Matrix3d offset_curvature(const Matrix3d& S, double d) {
  const Matrix3d grown = Matrix3d::Identity() + d * S;
  if (!(grown.determinant() > 0)) return Matrix3d::Zero();
  const Matrix3d H = S * grown.inverse();
  return (H + H.transpose()) / 2;
}

}  // namespace plastron::obstacle

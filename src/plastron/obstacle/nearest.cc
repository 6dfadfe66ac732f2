#include <plastron/obstacle/nearest.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::obstacle {

// The radius of the larger principal curvature. d's Hessian also has the eigenvalue 0, for its normal.
double roundness(const Nearest& nearest) {
  const double trace = nearest.curvature.trace();
  const double root = std::sqrt(std::max(2 * nearest.curvature.squaredNorm() - trace * trace, 0.0));
  const double largest = (trace + root) / 2;
  return largest > 0 ? 1 / largest - nearest.distance : std::numeric_limits<double>::infinity();
}

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

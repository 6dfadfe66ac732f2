#include <plastron/geometry/frame.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace plastron::geometry {

Frame frame_at(const SurfaceJet& phi) {
  Frame f;
  f.phi = phi.value;
  f.a_cov = phi.d;
  const Vector3d n = f.a_cov[0].cross(f.a_cov[1]);
  f.sqrt_a = n.norm();
  f.a3 = n / f.sqrt_a;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      f.metric_cov(a, b) = f.a_cov[a].dot(f.a_cov[b]);
      f.b_cov(a, b) = phi.dd[a + b].dot(f.a3);
    }
  f.metric_con = f.metric_cov.inverse();
  for (int a = 0; a < 2; ++a) f.a_con[a] = f.metric_con(a, 0) * f.a_cov[0] + f.metric_con(a, 1) * f.a_cov[1];
  for (int a = 0; a < 2; ++a) f.da3[a] = -(f.b_cov(a, 0) * f.a_con[0] + f.b_cov(a, 1) * f.a_con[1]);
  return f;
}

Frame frame_with_director(const Vector3d& phi, const std::array<Vector3d, 2>& tangents, const Vector3d& director,
                          const std::array<Vector3d, 2>& director_derivatives) {
  Frame f = frame_at({.value = phi, .d = tangents, .dd = {Vector3d(0, 0, 0), Vector3d(0, 0, 0), Vector3d(0, 0, 0)}});
  f.a3 = director;
  f.da3 = director_derivatives;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) f.b_cov(a, b) = -(f.a_cov[a].dot(f.da3[b]) + f.a_cov[b].dot(f.da3[a])) / 2;
  return f;
}

std::array<double, 2> principal_curvatures(const Frame& f) {
  const Matrix2d b_mixed = f.b_cov * f.metric_con;
  const double mean = b_mixed.trace() / 2;
  const double root = std::sqrt(std::max(0.0, mean * mean - b_mixed.determinant()));
  return {mean - root, mean + root};
}

MovingBasis moving_basis(const SurfaceJet& in_parameters, const std::array<Vector3d, 2>& tangents) {
  const Frame f = frame_at(in_parameters);
  MovingBasis basis;
  basis.a << f.a_con[0], f.a_con[1], f.a3;
  std::array<Matrix3d, 2> along_parameter;
  for (int a = 0; a < 2; ++a) {
    Matrix3d dc;
    dc << in_parameters.dd[a], in_parameters.dd[a + 1], f.da3[a];
    along_parameter[a] = -basis.a * dc.transpose() * basis.a;
  }
  for (int b = 0; b < 2; ++b)
    basis.da[b] = f.a_con[0].dot(tangents[b]) * along_parameter[0] + f.a_con[1].dot(tangents[b]) * along_parameter[1];
  return basis;
}

Matrix3d covariant_basis(const SurfaceJet& phi) {
  Matrix3d basis;
  basis << phi.d[0], phi.d[1], unit_normal(phi);
  return basis;
}

}  // namespace plastron::geometry

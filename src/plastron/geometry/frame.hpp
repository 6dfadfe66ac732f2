// The local frame of the mid-surface at a point, in the coordinates of a cell (M1-M3).
#pragma once
#include <plastron/geometry/jet.hpp>

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace plastron::geometry {

using Eigen::Matrix2d;
using Eigen::Matrix3d;

/// The frame. Names contain the position of the index: a_cov[alpha] = a_alpha, a_con[alpha] = a^alpha. On a chart a3 is
/// the unit normal. On a mesh in space it is the director, a field that is continuous across cells and takes the
/// normal's place in the strains; it is a unit vector and normal to the surface only up to the mesh's error.
struct Frame {
  Vector3d phi;                   ///< position [m]
  std::array<Vector3d, 2> a_cov;  ///< a_alpha = d_alpha phi [m per unit of the coordinate]
  std::array<Vector3d, 2> a_con;  ///< a^alpha
  Vector3d a3;                    ///< unit normal, or director
  std::array<Vector3d, 2> da3;    ///< d_alpha a_3
  Matrix2d metric_cov;            ///< a_{alpha beta}
  Matrix2d metric_con;            ///< a^{alpha beta}
  Matrix2d b_cov;                 ///< b_{alpha beta} = d_{alpha beta} phi . a_3
  double sqrt_a;                  ///< area element: dS = sqrt(a) dxi
};

/// Limit of |a_1 x a_2| relative to |a_1| |a_2|; below it a chart counts as degenerate.
inline constexpr double degenerate_sine = 1e-10;

/// |a_1 x a_2| / (|a_1| |a_2|): the sine of the angle between the tangents; 0 or NaN where the chart is degenerate.
inline double tangent_sine(const Frame& frame) {
  return frame.sqrt_a / (frame.a_cov[0].norm() * frame.a_cov[1].norm());
}

/// Returns only a_3.
inline Vector3d unit_normal(const SurfaceJet& phi) { return phi.d[0].cross(phi.d[1]).normalized(); }

/// The part of v that is normal to a3, a normal or a director.
inline Vector3d tangential(const Vector3d& v, const Vector3d& a3) { return v - a3.dot(v) / a3.squaredNorm() * a3; }

/// Returns the frame (M1)-(M3). Precondition: the chart is not degenerate at the point.
inline Frame frame_at(const SurfaceJet& phi) {
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

/// Returns the frame of tangents and a director. b_ab = -(a_a . d_b a_3 + a_b . d_a a_3) / 2.
inline Frame frame_with_director(const Vector3d& phi, const std::array<Vector3d, 2>& tangents, const Vector3d& director,
                                 const std::array<Vector3d, 2>& director_derivatives) {
  Frame f = frame_at({.value = phi, .d = tangents, .dd = {Vector3d(0, 0, 0), Vector3d(0, 0, 0), Vector3d(0, 0, 0)}});
  f.a3 = director;
  f.da3 = director_derivatives;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) f.b_cov(a, b) = -(f.a_cov[a].dot(f.da3[b]) + f.a_cov[b].dot(f.da3[a])) / 2;
  return f;
}

/// The unit normal a_1 x a_2 / sqrt(a), on the side of a_3.
inline Vector3d surface_normal(const Frame& f) {
  const Vector3d n = f.a_cov[0].cross(f.a_cov[1]) / f.sqrt_a;
  return n.dot(f.a3) < 0 ? Vector3d(-n) : n;
}

/// The derivative of phi along a direction of the coordinates.
inline Vector3d along(const Frame& f, const Vector2d& direction) {
  return direction[0] * f.a_cov[0] + direction[1] * f.a_cov[1];
}

/// Principal curvatures, the eigenvalues of b_alpha^beta, in ascending order [1/m].
inline std::array<double, 2> principal_curvatures(const Frame& f) {
  const Matrix2d b_mixed = f.b_cov * f.metric_con;
  const double mean = b_mixed.trace() / 2;
  const double root = std::sqrt(std::max(0.0, mean * mean - b_mixed.determinant()));
  return {mean - root, mean + root};
}

// The contravariant basis of a chart and its derivatives along the surface. The classical formulation (M15) expresses
// its unknowns in this basis.

/// Columns a^1, a^2, a_3 of the chart's own parameters, and their derivatives along the coordinates of a cell.
struct MovingBasis {
  Matrix3d a;
  std::array<Matrix3d, 2> da;
};

/// The covariant basis a_1, a_2, a_3 as columns.
inline Matrix3d covariant_basis(const SurfaceJet& phi) {
  Matrix3d basis;
  basis << phi.d[0], phi.d[1], unit_normal(phi);
  return basis;
}

/// Computes the basis from phi's jet at a point in the chart's parameters and the tangents of the cell's coordinates. With C =
/// [a_1 a_2 a_3] the contravariant basis is G = C^{-T}, hence dG = -G (dC)' G.
inline MovingBasis moving_basis(const SurfaceJet& in_parameters, const std::array<Vector3d, 2>& tangents) {
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

}  // namespace plastron::geometry

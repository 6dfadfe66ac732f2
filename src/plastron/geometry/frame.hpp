// The local frame of the mid-surface at a point, in the coordinates of a cell (M1-M3).
#pragma once
#include <plastron/geometry/jet.hpp>

#include <Eigen/Geometry>
#include <array>

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
Frame frame_at(const SurfaceJet& phi);

/// Returns the frame of tangents and a director. b_ab = -(a_a . d_b a_3 + a_b . d_a a_3) / 2.
Frame frame_with_director(const Vector3d& phi, const std::array<Vector3d, 2>& tangents, const Vector3d& director,
                          const std::array<Vector3d, 2>& director_derivatives);

/// The unit normal a_1 x a_2 / sqrt(a), on the side of a_3.
inline Vector3d surface_normal(const Frame& f) {
  const Vector3d n = f.a_cov[0].cross(f.a_cov[1]) / f.sqrt_a;
  return n.dot(f.a3) < 0 ? Vector3d(-n) : n;
}

/// Returns b_ab = -(a_a . d_b a_3 + a_b . d_a a_3) / 2.
inline Matrix2d curvature(const Frame& f) {
  const auto part = [&](std::size_t a, std::size_t b) { return -f.a_cov[a].dot(f.da3[b]); };
  Matrix2d b;
  b << part(0, 0), (part(0, 1) + part(1, 0)) / 2, (part(0, 1) + part(1, 0)) / 2, part(1, 1);
  return b;
}

/// The derivative of phi along a direction of the coordinates.
inline Vector3d along(const Frame& f, const Vector2d& direction) {
  return direction[0] * f.a_cov[0] + direction[1] * f.a_cov[1];
}

/// Principal curvatures, the eigenvalues of b_alpha^beta, in ascending order [1/m].
std::array<double, 2> principal_curvatures(const Frame& f);

// The contravariant basis of a chart and its derivatives along the surface. The classical formulation (M15) expresses
// its unknowns in this basis.

/// Columns a^1, a^2, a_3 of the chart's own parameters, and their derivatives along the coordinates of a cell.
struct MovingBasis {
  Matrix3d a;
  std::array<Matrix3d, 2> da;
};

/// The covariant basis a_1, a_2, a_3 as columns.
Matrix3d covariant_basis(const SurfaceJet& phi);

/// Computes the basis from phi's jet at a point in the chart's parameters and the tangents of the cell's coordinates. With C =
/// [a_1 a_2 a_3] the contravariant basis is G = C^{-T}, hence dG = -G (dC)' G.
MovingBasis moving_basis(const SurfaceJet& in_parameters, const std::array<Vector3d, 2>& tangents);

}  // namespace plastron::geometry

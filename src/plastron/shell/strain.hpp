// Naghdi's strains at a point as functions of the unknowns (u, r) and their derivatives (M4-M6), and the
// transposed map from stress resultants to generalised forces. Templated on the scalar for automatic
// differentiation. Symmetric pairs are stored as (11, 22, 2 x 12), shear as (2 delta_1, 2 delta_2).
//
// The strains of finite rotations (M24-M26) are polynomials of second degree in (u, r). Their derivative at a state is the
// same linear map, with y_a, d, d_a d in the place of a_a, a_3, d_a a_3 (deformed()).
#pragma once
#include <plastron/geometry/frame.hpp>

#include <Eigen/Core>
#include <array>

namespace plastron::shell {

using geometry::Frame;
using geometry::Vector3d;

template <class S>
using Vector3 = Eigen::Matrix<S, 3, 1>;

/// Input of the strains from (u, r) at a point: derivatives along the frame's coordinates, and r itself.
template <class S>
struct LocalField {
  std::array<Vector3<S>, 2> du;  ///< d_alpha u
  Vector3<S> r;                  ///< rotation of the normal [rad]
  std::array<Vector3<S>, 2> dr;  ///< d_alpha r
};

template <class S>
struct Strain {
  Vector3<S> membrane;           ///< gamma_11, gamma_22, 2 gamma_12
  Vector3<S> bending;            ///< chi_11, chi_22, 2 chi_12 [1/m]
  Eigen::Matrix<S, 2, 1> shear;  ///< 2 delta_13, 2 delta_23
};

/// Membrane strain (M4).
template <class S>
Vector3<S> membrane_strain(const LocalField<S>& v, const std::array<Vector3d, 2>& a_cov) {
  return {v.du[0].dot(a_cov[0].template cast<S>()), v.du[1].dot(a_cov[1].template cast<S>()),
          v.du[0].dot(a_cov[1].template cast<S>()) + v.du[1].dot(a_cov[0].template cast<S>())};
}

/// Bending strain (M5).
template <class S>
Vector3<S> bending_strain(const LocalField<S>& v, const Frame& f) {
  const auto pair = [&](int a, int b) -> S {
    return v.du[a].dot(f.da3[b].template cast<S>()) + v.dr[a].dot(f.a_cov[b].template cast<S>());
  };
  return {pair(0, 0), pair(1, 1), S(pair(0, 1) + pair(1, 0))};
}

/// Shear strain (M6).
template <class S>
Eigen::Matrix<S, 2, 1> shear_strain(const LocalField<S>& v, const std::array<Vector3d, 2>& a_cov, const Vector3d& a3) {
  const auto component = [&](int a) -> S {
    return v.du[a].dot(a3.template cast<S>()) + v.r.dot(a_cov[a].template cast<S>());
  };
  return {component(0), component(1)};
}

template <class S>
Strain<S> strain(const LocalField<S>& v, const Frame& f) {
  return {membrane_strain(v, f.a_cov), bending_strain(v, f), shear_strain(v, f.a_cov, f.a3)};
}

/// Moves the vectors of a point, or of a frame, by a field: y_a, d and, where there are any, d_a d (M23). Metric, area and
/// curvature stay those of the reference, as (M27) wants. strain(v, deformed(f, v / 2)) is the strain of finite rotations
/// (M24-M26), because this is a polynomial of second degree.
template <class Point>
void deform(Point& point, const LocalField<double>& v) {
  point.a3 += v.r;
  for (std::size_t a = 0; a < 2; ++a) point.a_cov[a] += v.du[a];
  if constexpr (requires { point.da3; })
    for (std::size_t a = 0; a < 2; ++a) point.da3[a] += v.dr[a];
}
inline Frame deformed(Frame f, const LocalField<double>& v) {
  deform(f, v);
  return f;
}

/// Replaces the same vectors by those of a field (phi, a_3).
template <class Point>
void replace(Point& point, const LocalField<double>& field) {
  point.a3 = field.r;
  point.a_cov = field.du;
  if constexpr (requires { point.da3; }) point.da3 = field.dr;
}
inline Frame replaced(Frame f, const LocalField<double>& field) {
  replace(f, field);
  return f;
}

/// Add the work-conjugates of LocalField: N : gamma + M : chi + Q . delta = sum du_dual . d u + r_dual . r + dr_dual
/// . d r. The functions are the three transposed strain maps.
inline void add_membrane_dual(const Vector3d& n, const std::array<Vector3d, 2>& a_cov, LocalField<double>& dual) {
  dual.du[0] += n[0] * a_cov[0] + n[2] * a_cov[1];
  dual.du[1] += n[2] * a_cov[0] + n[1] * a_cov[1];
}
inline void add_bending_dual(const Vector3d& m, const Frame& f, LocalField<double>& dual) {
  dual.du[0] += m[0] * f.da3[0] + m[2] * f.da3[1];
  dual.du[1] += m[2] * f.da3[0] + m[1] * f.da3[1];
  dual.dr[0] += m[0] * f.a_cov[0] + m[2] * f.a_cov[1];
  dual.dr[1] += m[2] * f.a_cov[0] + m[1] * f.a_cov[1];
}
inline void add_shear_dual(const Eigen::Vector2d& q, const std::array<Vector3d, 2>& a_cov, const Vector3d& a3,
                           LocalField<double>& dual) {
  dual.du[0] += q[0] * a3;
  dual.du[1] += q[1] * a3;
  dual.r += q[0] * a_cov[0] + q[1] * a_cov[1];
}

// The gradient of the normal part of the rotation, r . a_3, which is zero for the exact solution. The penalty (M13), the
// stabilisation and the multiplier (M14) use it.

/// d_alpha (r . a_3) = d_alpha r . a_3 + r . d_alpha a_3
inline Eigen::Vector2d normal_rotation_gradient(const LocalField<double>& v, const Frame& f) {
  return {v.dr[0].dot(f.a3) + v.r.dot(f.da3[0]), v.dr[1].dot(f.a3) + v.r.dot(f.da3[1])};
}

/// The transposed map, added to `dual`.
inline void add_normal_rotation_dual(const Eigen::Vector2d& t, const Frame& f, LocalField<double>& dual) {
  dual.dr[0] += t[0] * f.a3;
  dual.dr[1] += t[1] * f.a3;
  dual.r += t[0] * f.da3[0] + t[1] * f.da3[1];
}

/// The zero field.
inline LocalField<double> zero_field() {
  const Vector3d z = Vector3d::Zero();
  return {{z, z}, z, {z, z}};
}

}  // namespace plastron::shell

// The gradient at a point of the normal part of the rotation, r . a_3, which is zero for the exact solution. The
// penalty (M13), the stabilisation and the multiplier (M14) use it.
#pragma once
#include <plastron/shell/strain.hpp>

namespace plastron::shell {

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

}  // namespace plastron::shell

// Random displacements, rotations and rigid motions at a point of a surface. They are the same in every run.
#pragma once
#include <plastron/shell/material.hpp>

#include <random>

namespace plastron::shell {

using geometry::Frame;
using geometry::SurfaceJet;

class Random {
 public:
  double number() { return distribution_(generator_); }
  Vector3d vector() { return {number(), number(), number()}; }
  LocalField<double> field() { return {{vector(), vector()}, vector(), {vector(), vector()}}; }
  Eigen::Matrix2d metric() {
    const Eigen::Matrix2d g{{number(), number()}, {number(), number()}};
    return g * g.transpose() + Eigen::Matrix2d::Identity();
  }

 private:
  std::mt19937 generator_{20260701};
  std::uniform_real_distribution<double> distribution_{-1, 1};
};

/// u = c + w x phi, r = w x a_3: only the derivatives of u are needed, so c does not appear.
inline LocalField<double> rigid_motion(const Frame& f, const Vector3d& w) {
  return {{w.cross(f.a_cov[0]), w.cross(f.a_cov[1])}, w.cross(f.a3), {w.cross(f.da3[0]), w.cross(f.da3[1])}};
}

/// The same field in other coordinates with Jacobian J.
inline LocalField<double> in_coordinates(const LocalField<double>& v, const Eigen::Matrix2d& J) {
  LocalField<double> w = v;
  for (int a = 0; a < 2; ++a) {
    w.du[a] = v.du[0] * J(0, a) + v.du[1] * J(1, a);
    w.dr[a] = v.dr[0] * J(0, a) + v.dr[1] * J(1, a);
  }
  return w;
}

/// The inner product of two local fields: the work of a dual field on a field.
inline double work(const LocalField<double>& dual, const LocalField<double>& v) {
  double sum = dual.r.dot(v.r);
  for (std::size_t a = 0; a < 2; ++a) sum += dual.du[a].dot(v.du[a]) + dual.dr[a].dot(v.dr[a]);
  return sum;
}

inline double work(const Resultants<double>& n, const Strain<double>& s) {
  return n.membrane.dot(s.membrane) + n.bending.dot(s.bending) + n.shear.dot(s.shear);
}

inline LocalField<double> dual_of(const Resultants<double>& n, const Frame& f) {
  LocalField<double> dual = zero_field();
  add_membrane_dual(n.membrane, f.a_cov, dual);
  add_bending_dual(n.bending, f, dual);
  add_shear_dual(n.shear, f.a_cov, f.a3, dual);
  return dual;
}

}  // namespace plastron::shell

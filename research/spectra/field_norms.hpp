// Norms of discrete fields over the mid-surface: L2 and H1 of u and r (M10), and the distance to Koiter's rotation.
#pragma once
#include <plastron/energy/shell_operator.hpp>

namespace plastron::spectra {

/// Squares of  |v| = (int v . v sqrt(a) dx)^{1/2}  and  |grad v| = (int a^{ab} d_a v . d_b v sqrt(a) dx)^{1/2}.
struct SquaredNorms {
  double u = 0, grad_u = 0;  ///< [m^4], [m^2]
  double r = 0, grad_r = 0;  ///< [m^2], [1]

  /// Squared norms of (u, r) in L2 x L2 and H1 x H1, the paper's spaces. They are pure numbers: the unit of length is
  /// `length` [m], a length of the shell (research/spectra/spectra.hpp).
  double l2(double length) const { return (u / (length * length) + r) / (length * length); }
  double h1(double length) const { return h1_u(length) + h1_r(length); }
  double h1_u(double length) const { return (u / (length * length) + grad_u) / (length * length); }
  double h1_r(double length) const { return r / (length * length) + grad_r; }
};

/// Returns the norms of Cartesian nodal values y = (u, r), block 6 with valid ghosts, at the Gauss points of the
/// stiffness (collective).
SquaredNorms squared_norms(const energy::ShellOperator& shell, const algebra::Vector& y);

/// Returns |r - r_K|^2 = int a^{ab} 2 delta_{a3} 2 delta_{b3} sqrt(a) dx [m^2] (collective). r_K = -(d_a u . a_3) a^a
/// is the rotation of Koiter's model for the same u (Remark 2 of the paper, sign corrected): r - r_K = 2 delta_{a3} a^a
/// for tangent r (M6). The shear strain is the strain of the method, tied where tying is on (M22).
double squared_distance_to_koiter(const energy::ShellOperator& shell, const algebra::Vector& y);

}  // namespace plastron::spectra

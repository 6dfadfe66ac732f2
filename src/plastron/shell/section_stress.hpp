// Stresses over a cross-section from its resultants. Naghdi's strains are linear in the height z; therefore the
// in-plane stresses are linear, and their integrals over the thickness are N and M exactly. The transverse shear
// stress is constant according to the kinematics. According to equilibrium it is the parabola with the same resultant
// that vanishes on both faces. Tensors are components in orthonormal tangents t1, t2, in the order 11, 22, 12. The
// normal stress sigma_33 is neglected (plane stress).
#pragma once
#include <plastron/shell/energy.hpp>

#include <cmath>

namespace plastron::shell {

/// Resultants of a cross-section, and its thickness.
struct SectionForces {
  Vector3d N = Vector3d::Zero();                ///< membrane forces [N/m]
  Vector3d M = Vector3d::Zero();                ///< bending moments [N]
  Eigen::Vector2d Q = Eigen::Vector2d::Zero();  ///< transverse shear forces [N/m]
  double thickness = 1;                         ///< e [m]
};

/// sigma^{ab} = N^{ab} / e + 12 z M^{ab} / e^3 at the height z in [-e/2, e/2] along a_3 [Pa]: (M7), (M8).
inline Vector3d in_plane_stress(const SectionForces& f, double z) {
  const double e = f.thickness;
  return f.N / e + 12 * z / (e * e * e) * f.M;
}

/// Mean of sigma^{a3}: Q^a / e, constant over the thickness [Pa].
inline Eigen::Vector2d mean_shear_stress(const SectionForces& f) { return f.Q / f.thickness; }

/// Parabola of sigma^{a3}: 3/2 Q^a / e (1 - (2 z / e)^2) [Pa].
inline Eigen::Vector2d parabolic_shear_stress(const SectionForces& f, double z) {
  const double s = 2 * z / f.thickness;
  return 1.5 * (1 - s * s) / f.thickness * f.Q;
}

/// Equivalent stress of von Mises: sqrt(s11^2 - s11 s22 + s22^2 + 3 (s12^2 + t1^2 + t2^2)) [Pa].
inline double von_mises(const Vector3d& s, const Eigen::Vector2d& shear) {
  return std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * (s[2] * s[2] + shear.squaredNorm()));
}

/// Equivalent stress of the in-plane stress and the parabolic shear stress at the height z [Pa].
inline double von_mises_at(const SectionForces& f, double z) {
  return von_mises(in_plane_stress(f, z), parabolic_shear_stress(f, z));
}

/// Derivative of von_mises_at a height with respect to N_11 N_22 N_12 M_11 M_22 M_12 Q_1 Q_2; zero without stress.
inline Eigen::Matrix<double, 8, 1> von_mises_derivative(const SectionForces& f, double z) {
  Eigen::Matrix<double, 8, 1> derivative = Eigen::Matrix<double, 8, 1>::Zero();
  const Vector3d s = in_plane_stress(f, z);
  const Eigen::Vector2d shear = parabolic_shear_stress(f, z);
  const double stress = von_mises(s, shear), e = f.thickness, side = 2 * z / e;
  if (!(stress > 0)) return derivative;
  const Vector3d in_plane = Vector3d(2 * s[0] - s[1], 2 * s[1] - s[0], 6 * s[2]) / (2 * stress);
  derivative << in_plane / e, 12 * z / (e * e * e) * in_plane, 3 / stress * 1.5 * (1 - side * side) / e * shear;
  return derivative;
}

struct LargestVonMises {
  double stress = 0;  ///< [Pa]
  double height = 0;  ///< height z of the stress [m]
};

/// The largest von_mises_at over the thickness. Its square is A + B s + C s^2 + D (1 - s^2)^2, s = 2 z / e in [-1,
/// 1], with C, D >= 0.
inline LargestVonMises largest_von_mises(const SectionForces& f) {
  LargestVonMises largest;
  const auto look_at = [&](double s) {
    const double z = s * f.thickness / 2, stress = von_mises_at(f, z);
    if (stress > largest.stress) largest = {stress, z};
  };
  look_at(0);
  look_at(-1);
  look_at(1);
  const Vector3d constant = f.N / f.thickness, slope = 6 / (f.thickness * f.thickness) * f.M;
  const auto product = [](const Vector3d& a, const Vector3d& b) {
    return a[0] * b[0] - (a[0] * b[1] + a[1] * b[0]) / 2 + a[1] * b[1] + 3 * a[2] * b[2];
  };
  const double D = 6.75 * f.Q.squaredNorm() / (f.thickness * f.thickness);
  const double inner = 2 * D - product(slope, slope);
  if (inner <= 0) return largest;  // convex
  // The middle one of the three roots of s^3 - 3 a^2 s + q, where the derivative vanishes, is the only inner maximum.
  const double a = std::sqrt(inner / (6 * D)), q = product(constant, slope) / (2 * D);
  const double sine = q / (2 * a * a * a);
  if (std::abs(sine) < 1) look_at(2 * a * std::sin(std::asin(sine) / 3));
  return largest;
}

/// Eigenvalues of a symmetric tensor in the tangent plane, and the direction of the first.
struct Principal {
  double first = 0, second = 0;  ///< first >= second
  double angle = 0;              ///< angle from t1 towards t2, in (-pi/2, pi/2] [rad]
};

inline Principal principal(const Vector3d& t) {
  const double mean = (t[0] + t[1]) / 2, half = (t[0] - t[1]) / 2, radius = std::hypot(half, t[2]);
  return {mean + radius, mean - radius, std::atan2(t[2], half) / 2};
}

/// Energy per mid-surface area of the resultants (M8), from the compliances [J/m^2].
inline EnergyDensity energy_density(const Material& material, const SectionForces& f) {
  const double e = f.thickness, young = material.young(), poisson = young / (2 * material.mu) - 1;
  const auto in_plane = [&](const Vector3d& t) {
    const double trace = t[0] + t[1], square = t[0] * t[0] + t[1] * t[1] + 2 * t[2] * t[2];
    return ((1 + poisson) * square - poisson * trace * trace) / (2 * young);
  };
  return {in_plane(f.N) / e, 12 / (e * e * e) * in_plane(f.M),
          f.Q.squaredNorm() / (2 * material.shear_correction * e * material.mu)};
}

}  // namespace plastron::shell

// Stresses over a cross-section from its resultants. Naghdi's strains are linear in the height z. In a homogeneous
// section the in-plane stresses are therefore linear, and their integrals over the thickness are N and M exactly. In a
// laminate they are linear in each layer. The transverse shear stress is constant according to the kinematics.
// According to equilibrium it has the same resultant and vanishes on both faces: a parabola in a homogeneous section.
// Tensors are components in orthonormal tangents t1, t2, in the order 11, 22, 12. The normal stress sigma_33 is
// neglected (plane stress).
#pragma once
#include <plastron/shell/material.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace plastron::shell {

/// Resultants of a cross-section, and what determines the stresses besides them.
struct SectionForces {
  Vector3d N = Vector3d::Zero();                      ///< membrane forces [N/m]
  Vector3d M = Vector3d::Zero();                      ///< bending moments [N]
  Eigen::Vector2d Q = Eigen::Vector2d::Zero();        ///< transverse shear forces [N/m]
  double thickness = 1;                               ///< e [m]
  std::shared_ptr<const LaminateSection> laminate{};  ///< null for a homogeneous section

  Vector8 all() const {
    Vector8 n;
    n << N, M, Q;
    return n;
  }
};

/// Stresses at a point of a cross-section [Pa].
struct Stress {
  Vector3d in_plane;      ///< sigma_11, sigma_22, sigma_12
  Eigen::Vector2d shear;  ///< sigma_13, sigma_23
};

inline Stress stress_of(const StressMap& s, const SectionForces& f) {
  const Eigen::Matrix<double, 5, 1> all = s.map * f.all() + s.constant;
  return {all.head<3>(), all.tail<2>()};
}

/// Map of the stresses at the height z: in a homogeneous section N/e + 12 z M/e^3 and 3/2 Q/e (1 - (2 z/e)^2).
inline StressMap stress_map(const SectionForces& f, double z) {
  if (f.laminate) return f.laminate->stress(f.laminate->layer_at(z), z);
  const double e = f.thickness, side = 2 * z / e;
  StressMap s;
  s.map.topLeftCorner<3, 3>().diagonal().setConstant(1 / e);
  s.map.block<3, 3>(0, 3).diagonal().setConstant(12 * z / (e * e * e));
  s.map.bottomRightCorner<2, 2>().diagonal().setConstant(1.5 * (1 - side * side) / e);
  return s;
}

/// Stresses at the height z in [-e/2, e/2] along a_3 [Pa]: (M7), (M8).
inline Stress stress_at(const SectionForces& f, double z) { return stress_of(stress_map(f, z), f); }
inline Vector3d in_plane_stress(const SectionForces& f, double z) { return stress_at(f, z).in_plane; }
inline Eigen::Vector2d shear_stress(const SectionForces& f, double z) { return stress_at(f, z).shear; }

/// Mean of sigma^{a3}: Q^a / e, constant over the thickness [Pa].
inline Eigen::Vector2d mean_shear_stress(const SectionForces& f) { return f.Q / f.thickness; }

/// Equivalent stress of von Mises: sqrt(s11^2 - s11 s22 + s22^2 + 3 (s12^2 + t1^2 + t2^2)) [Pa].
inline double von_mises(const Vector3d& s, const Eigen::Vector2d& shear) {
  return std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * (s[2] * s[2] + shear.squaredNorm()));
}

inline double von_mises(const Stress& s) { return von_mises(s.in_plane, s.shear); }

/// Equivalent stress at the height z [Pa].
inline double von_mises_at(const SectionForces& f, double z) { return von_mises(stress_at(f, z)); }

/// Derivative of von_mises_at a height with respect to N_11 N_22 N_12 M_11 M_22 M_12 Q_1 Q_2; zero without stress.
inline Vector8 von_mises_derivative(const SectionForces& f, double z) {
  const StressMap map = stress_map(f, z);
  const Stress at = stress_of(map, f);
  const Vector3d& s = at.in_plane;
  const double stress = von_mises(at);
  if (!(stress > 0)) return Vector8::Zero();
  Eigen::Matrix<double, 5, 1> by_stress;
  by_stress << Vector3d(2 * s[0] - s[1], 2 * s[1] - s[0], 6 * s[2]) / (2 * stress), 3 / stress * at.shear;
  return map.map.transpose() * by_stress;
}

struct LargestVonMises {
  double stress = 0;  ///< [Pa]
  double height = 0;  ///< height z of the stress [m]
};

/// The largest von_mises_at over the layers of a laminate. In each layer its square is a polynomial of degree 4 in z;
/// the neighbourhood of the largest of several samples is searched by thirds.
inline LargestVonMises largest_in_laminate(const SectionForces& f) {
  constexpr int samples = 8, thirds = 30;
  LargestVonMises largest;
  for (std::size_t k = 0; k < f.laminate->layer_count(); ++k) {
    const double bottom = f.laminate->interface(k), step = (f.laminate->interface(k + 1) - bottom) / samples;
    const auto stress = [&](double z) { return von_mises(stress_of(f.laminate->stress(k, z), f)); };
    int best = 0;
    for (int i = 1; i <= samples; ++i)
      if (stress(bottom + i * step) > stress(bottom + best * step)) best = i;
    double low = bottom + std::max(best - 1, 0) * step, high = bottom + std::min(best + 1, samples) * step;
    for (int i = 0; i < thirds; ++i) {
      const double first = low + (high - low) / 3, second = high - (high - low) / 3;
      if (stress(first) < stress(second))
        low = first;
      else
        high = second;
    }
    for (const double z : {bottom + best * step, (low + high) / 2})
      if (stress(z) > largest.stress) largest = {stress(z), z};
  }
  return largest;
}

/// The largest von_mises_at over the thickness. Its square is A + B s + C s^2 + D (1 - s^2)^2, s = 2 z / e in [-1,
/// 1], with C, D >= 0.
inline LargestVonMises largest_von_mises(const SectionForces& f) {
  if (f.laminate) return largest_in_laminate(f);
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

/// Energy per mid-surface area of the resultants (M8), from the compliances [J/m^2]. With initial strains it is the
/// energy of the total strains.
inline EnergyDensity energy_density(const Material& material, const SectionForces& f) {
  const Section section =
      f.laminate ? f.laminate->section()
                 : section_at(material, orthonormal_frame(Vector3d::UnitX(), Vector3d::UnitY()), f.thickness);
  const Vector8 n = f.all() + section.initial_resultants(), strains = section.strains_of(n);
  return {n.head<3>().dot(strains.head<3>()) / 2, n.segment<3>(3).dot(strains.segment<3>(3)) / 2,
          n.tail<2>().dot(strains.tail<2>()) / 2};
}

}  // namespace plastron::shell

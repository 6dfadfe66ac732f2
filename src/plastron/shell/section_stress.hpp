// Stresses over a cross-section from its resultants. Naghdi's strains are linear in the height z. In a homogeneous
// section the in-plane stresses are therefore linear, and their integrals over the thickness are N and M exactly. In a
// laminate they are linear in each layer. The transverse shear stress is constant according to the kinematics.
// According to equilibrium it has the same resultant and vanishes on both faces: a parabola in a homogeneous section.
// Tensors are components in orthonormal tangents t1, t2, in the order 11, 22, 12. The normal stress sigma_33 is
// neglected (plane stress).
#pragma once
#include <plastron/shell/material.hpp>

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

Stress stress_of(const StressMap& s, const SectionForces& f);

/// Map of the stresses at the height z: in a homogeneous section N/e + 12 z M/e^3 and 3/2 Q/e (1 - (2 z/e)^2).
StressMap stress_map(const SectionForces& f, double z);

/// Stresses at the height z in [-e/2, e/2] along a_3 [Pa]: (M7), (M8).
Stress stress_at(const SectionForces& f, double z);
Vector3d in_plane_stress(const SectionForces& f, double z);
Eigen::Vector2d shear_stress(const SectionForces& f, double z);

/// Mean of sigma^{a3}: Q^a / e, constant over the thickness [Pa].
Eigen::Vector2d mean_shear_stress(const SectionForces& f);

/// Equivalent stress of von Mises: sqrt(s11^2 - s11 s22 + s22^2 + 3 (s12^2 + t1^2 + t2^2)) [Pa].
double von_mises(const Vector3d& s, const Eigen::Vector2d& shear);

double von_mises(const Stress& s);

/// Equivalent stress at the height z [Pa].
double von_mises_at(const SectionForces& f, double z);

/// Derivative of von_mises_at a height with respect to N_11 N_22 N_12 M_11 M_22 M_12 Q_1 Q_2; zero without stress.
Vector8 von_mises_derivative(const SectionForces& f, double z);

struct LargestVonMises {
  double stress = 0;  ///< [Pa]
  double height = 0;  ///< height z of the stress [m]
};

/// The largest von_mises_at over the thickness. Its square is A + B s + C s^2 + D (1 - s^2)^2, s = 2 z / e in [-1,
/// 1], with C, D >= 0.
LargestVonMises largest_von_mises(const SectionForces& f);

/// Eigenvalues of a symmetric tensor in the tangent plane, and the direction of the first.
struct Principal {
  double first = 0, second = 0;  ///< first >= second
  double angle = 0;              ///< angle from t1 towards t2, in (-pi/2, pi/2] [rad]
};

Principal principal(const Vector3d& t);

/// Energy per mid-surface area of the resultants (M8), from the compliances [J/m^2].
EnergyDensity energy_density(const Material& material, const SectionForces& f);

}  // namespace plastron::shell

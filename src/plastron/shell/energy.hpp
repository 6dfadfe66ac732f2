// Energy density and stress resultants at a point (M8).
#pragma once
#include <plastron/shell/material.hpp>
#include <plastron/shell/strain.hpp>

namespace plastron::shell {

/// The stiffness of a cross-section of thickness e: it maps strains to resultants.
struct SectionStiffness {
  Eigen::Matrix3d membrane;  ///< e a^{abrs} [N/m]
  Eigen::Matrix3d bending;   ///< e^3/12 a^{abrs} [N m]
  Eigen::Matrix2d shear;     ///< k_s e mu a^{ab} [N/m]
};

inline SectionStiffness section_stiffness(const Material& material, double thickness,
                                          const Eigen::Matrix2d& metric_con) {
  const Eigen::Matrix3d c = elasticity(material, metric_con);
  const double e = thickness;
  return {e * c, e * e * e / 12 * c, material.shear_correction * e * material.mu * metric_con};
}

/// N^{ab} [N/m], M^{ab} [N] in the order 11, 22, 12, and Q^a [N/m]: contravariant components.
template <class S>
struct Resultants {
  Vector3<S> membrane;           ///< N^11, N^22, N^12
  Vector3<S> bending;            ///< M^11, M^22, M^12
  Eigen::Matrix<S, 2, 1> shear;  ///< Q^1, Q^2
};

template <class S>
Resultants<S> resultants(const SectionStiffness& c, const Strain<S>& s) {
  return {c.membrane.template cast<S>() * s.membrane, c.bending.template cast<S>() * s.bending,
          c.shear.template cast<S>() * s.shear};
}

struct EnergyDensity {
  double membrane = 0, bending = 0, shear = 0;  ///< per mid-surface area [J/m^2]
};

inline EnergyDensity energy_density(const SectionStiffness& c, const Strain<double>& s) {
  return {s.membrane.dot(c.membrane * s.membrane) / 2, s.bending.dot(c.bending * s.bending) / 2,
          s.shear.dot(c.shear * s.shear) / 2};
}

/// The total density as one differentiable function of the strain: its derivative is resultants().
template <class S>
S total_energy_density(const SectionStiffness& c, const Strain<S>& s) {
  const Resultants<S> n = resultants(c, s);
  return (s.membrane.dot(n.membrane) + s.bending.dot(n.bending) + s.shear.dot(n.shear)) / S(2);
}

}  // namespace plastron::shell

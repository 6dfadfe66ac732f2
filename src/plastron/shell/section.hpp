// The stiffness of a cross-section at a point, its stress resultants and its energy (M8).
#pragma once
#include <plastron/shell/strain.hpp>

#include <Eigen/Core>

namespace plastron::shell {

/// Strains or resultants of a point in one vector: membrane 11, 22, 12, bending 11, 22, 12, shear 1, 2.
using Vector8 = Eigen::Matrix<double, 8, 1>;

/// What strains a cross-section without stress (M34): the temperature T_m + (z / e) dT over that without stress, and a factor of the
/// initial strains that layers have. A curved shell that grows evenly by alpha T_m has the strains gamma = alpha T_m a, chi = -alpha T_m b,
/// as the length of directors stays: both are strains without stress.
struct InitialState {
  double strains = 1;
  double temperature = 0;                               ///< T_m [K]
  double difference = 0;                                ///< dT, of the upper face less that of the lower face [K]
  Eigen::Vector3d curvature = Eigen::Vector3d::Zero();  ///< b_11, b_22, 2 b_12 in the components of the section [1/m]

  bool is_heated() const { return temperature != 0 || difference != 0; }
};

/// A cross-section at a point. It maps strains to resultants:
///
///     N = A gamma + B chi - N_0,     M = B gamma + D chi - M_0,     Q = S (2 delta).
///
/// Components are those of the basis in which the section was computed, contravariant for a frame.
struct Section {
  Eigen::Matrix3d membrane;                                  ///< A = int C dz [N/m]; isotropic: e a^{abrs}
  Eigen::Matrix3d bending;                                   ///< D = int z^2 C dz [N m]; isotropic: e^3/12 a^{abrs}
  Eigen::Matrix2d shear;                                     ///< S [N/m]; isotropic: k_s e mu a^{ab}
  Eigen::Matrix3d coupling = Eigen::Matrix3d::Zero();        ///< B = int z C dz [N]; zero for symmetric sections
  Eigen::Vector3d initial_force = Eigen::Vector3d::Zero();   ///< N_0 = int C eps_0 dz of initial strains eps_0 [N/m]
  Eigen::Vector3d initial_moment = Eigen::Vector3d::Zero();  ///< M_0 = int z C eps_0 dz [N]

  bool is_coupled() const;
  bool has_initial_strains() const;
  /// Returns A, B, D as one matrix of the strains gamma and chi.
  Eigen::Matrix<double, 6, 6> in_plane() const;
  /// Returns the resultants of strains, without N_0 and M_0.
  Vector8 resultants_of(const Vector8& strains) const;
  /// Returns the strains of resultants, without N_0 and M_0.
  Vector8 strains_of(const Vector8& resultants) const;
  /// Returns N_0, M_0 and zeros.
  Vector8 initial_resultants() const;
  /// Returns D - B A^{-1} B, the bending stiffness of a section whose membrane forces are zero [N m].
  Eigen::Matrix3d bending_without_force() const;
};

// The lengths of boundary layers, for a section in orthonormal axes whose first axis is normal to the edge.

/// sqrt(D_11 / S_11): the length over which bending across an edge decays by shear [m].
double bending_length(const Section& s);
/// sqrt(D_66 / S_22): the length over which the twisting moment of a free edge decays [m].
double twist_length(const Section& s);

/// N^{ab} [N/m], M^{ab} [N] in the order 11, 22, 12, and Q^a [N/m]: contravariant components.
template <class S>
struct Resultants {
  Vector3<S> membrane;           ///< N^11, N^22, N^12
  Vector3<S> bending;            ///< M^11, M^22, M^12
  Eigen::Matrix<S, 2, 1> shear;  ///< Q^1, Q^2
};

/// Returns the resultants of strains, without N_0 and M_0.
template <class S>
Resultants<S> resultants(const Section& c, const Strain<S>& s) {
  const Eigen::Matrix<S, 3, 3> coupling = c.coupling.template cast<S>();
  return {c.membrane.template cast<S>() * s.membrane + coupling * s.bending,
          coupling * s.membrane + c.bending.template cast<S>() * s.bending, c.shear.template cast<S>() * s.shear};
}

/// Energy per mid-surface area [J/m^2]: N : gamma / 2, M : chi / 2 and Q . delta. With coupling, one of the first two
/// may be negative; their sum is not.
struct EnergyDensity {
  double membrane = 0, bending = 0, shear = 0;
};

/// Returns the energy density of strains, without initial strains.
EnergyDensity energy_density(const Section& c, const Strain<double>& s);

/// The total density as one differentiable function of the strain: its derivative is resultants().
template <class S>
S total_energy_density(const Section& c, const Strain<S>& s) {
  const Resultants<S> n = resultants(c, s);
  return (s.membrane.dot(n.membrane) + s.bending.dot(n.bending) + s.shear.dot(n.shear)) / S(2);
}

}  // namespace plastron::shell

// Laminates: orthotropic layers, bonded over the whole thickness. The strains are Naghdi's, linear in the height z.
// Each layer has its own plane-stress stiffness. Classical lamination theory with transverse shear: Reddy, Mechanics of
// Laminated Composite Plates and Shells, 2nd edition, CRC Press 2004, chapters 1 to 3. Transverse shear stresses and the
// stiffness against them follow from equilibrium through the thickness (docs/methods/laminates.md).
#pragma once
#include <plastron/geometry/frame.hpp>
#include <plastron/shell/section.hpp>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

namespace plastron::shell {

/// Elastic constants of a layer in its own axes 1, 2 and the normal 3, for plane stress [Pa].
struct Orthotropic {
  double E1 = 0, E2 = 0;                  ///< Young's moduli
  double nu12 = 0;                        ///< contraction along 2 by a stress along 1; nu21 = nu12 E2 / E1
  double G12 = 0, G13 = 0, G23 = 0;       ///< shear moduli
  double expansion1 = 0, expansion2 = 0;  ///< strains per temperature [1/K]

  static Orthotropic isotropic(double E, double nu, double expansion = 0) {
    const double G = E / (2 * (1 + nu));
    return {E, E, nu, G, G, G, expansion, expansion};
  }
  /// Returns eps_1, eps_2, 2 eps_12 for each kelvin.
  Vector3d expansion() const { return {expansion1, expansion2, 0}; }
  /// Returns the symmetric part of the product of the expansion and a curvature, b_1, b_2, 2 b_12 in the layer's axes.
  Vector3d bent_expansion(const Vector3d& curvature) const {
    return {expansion1 * curvature[0], expansion2 * curvature[1], (expansion1 + expansion2) / 2 * curvature[2]};
  }
  /// Returns whether every strain costs energy: positive moduli, and nu12^2 < E1 / E2.
  bool is_positive_definite() const;
  /// Returns the stiffness of (eps_1, eps_2, 2 eps_12) [Pa].
  Eigen::Matrix3d in_plane() const;
};

struct Layer {
  Orthotropic material{};
  double part = 1;                     ///< the layer's part of the thickness, relative to those of the other layers
  double angle = 0;                    ///< from the laminate's direction to the layer's axis 1, about a_3 [rad]
  Vector3d strain = Vector3d::Zero();  ///< initial strains eps_1, eps_2, 2 eps_12 in the layer's axes: free of stress
};

/// Maps strains to stresses at a height, both for given resultants: sigma = map (N, M, Q) + constant, with sigma_11,
/// sigma_22, sigma_12, sigma_13, sigma_23 in orthonormal axes.
struct StressMap {
  Eigen::Matrix<double, 5, 8> map = Eigen::Matrix<double, 5, 8>::Zero();
  Eigen::Matrix<double, 5, 1> constant = Eigen::Matrix<double, 5, 1>::Zero();
};

/// Transverse shear stresses of a laminate of thickness 1. If only Q_1 acts in the axes of bending, then d_1 M_11 = Q_1, and no
/// other resultant changes. Equilibrium d_1 sigma_1a + d_3 sigma_a3 = 0 gives the stress by integration over z.
class TransverseShear {
 public:
  /// `interfaces`: heights between layers, with both faces. `in_plane`: A, B, D in the laminate's axes.
  TransverseShear(const std::vector<Layer>& layers, const std::vector<double>& interfaces,
                  const Eigen::Matrix<double, 6, 6>& in_plane);

  /// Returns the map of Q to (sigma_13, sigma_23) at a height in a layer, both in the laminate's axes.
  Eigen::Matrix2d stress(std::size_t layer, double z) const;
  /// Returns the stiffness with the energy of these stresses, Q . F Q / 2 = Q . S^{-1} Q / 2, in the laminate's axes.
  Eigen::Matrix2d stiffness() const;

 private:
  struct Ply {
    Eigen::Matrix3d stiffness;     // of strains in the axes of bending
    Eigen::Matrix2d moduli;        // of transverse shear, likewise
    Eigen::Matrix2d at_interface;  // maps Q to the stress at the interface below, likewise
  };
  /// Maps Q to the change of the stress in a ply between two heights, in the axes of bending.
  Eigen::Matrix2d gain(const Ply& ply, double from, double to) const;
  Eigen::Matrix2d stress_in_bending_axes(std::size_t layer, double z) const {
    return plies_[layer].at_interface + gain(plies_[layer], interfaces_[layer], z);
  }

  std::vector<double> interfaces_;
  Eigen::Matrix2d axes_;  // axes of bending in the laminate's axes
  Eigen::Matrix<double, 6, 6> compliance_;
  std::vector<Ply> plies_{};
};

class Laminate {
 public:
  /// `layers`: from the lower to the upper face, at least one. `direction`: its projection on the tangent plane is the
  /// laminate's axis 1.
  Laminate(std::vector<Layer> layers, const Vector3d& direction);

  const std::vector<Layer>& layers() const { return layers_; }
  /// Returns z/e between layers k - 1 and k; -1/2 and 1/2 on the faces.
  double interface(std::size_t k) const { return interfaces_[k]; }
  /// Returns the mean of Young's moduli of all layers in both directions [Pa].
  double young() const;
  /// Returns the mean of G13 and G23 of all layers [Pa].
  double shear_modulus() const;
  bool has_initial_strains() const { return unit_.has_initial_strains(); }
  /// Whether temperatures strain some layer.
  bool expands() const;
  const TransverseShear& transverse_shear() const { return transverse_shear_; }
  /// Returns the length over which stiff faces on soft layers bend each on its own, as a part of the thickness; 0 without soft
  /// layers. One director describes the section only where strains change over much longer distances.
  double face_length() const;

  /// Returns whether the direction has a projection: whether its angle to the normal has a sine of at least 0.01.
  bool has_axes(const Vector3d& a3) const;
  /// Returns the components of the laminate's axes 1, 2 (rows) along the frame's a_1, a_2. Precondition: has_axes().
  Eigen::Matrix2d axes(const geometry::Frame& frame) const;
  /// Returns the cross-section in the components of `axes`. `shear_correction`: 5/6 for the shear stiffness from
  /// equilibrium, as in a homogeneous section.
  Section section(const Eigen::Matrix2d& axes, double thickness, double shear_correction,
                  const InitialState& initial) const;

 private:
  std::vector<Layer> layers_;
  std::vector<double> interfaces_;
  Vector3d direction_;
  Section unit_;  // thickness 1, shear correction 1, in the laminate's axes
  /// int C alpha z^k dz over the thickness 1, in the laminate's axes: the stresses of a temperature z^(k - 1).
  std::array<Vector3d, 3> stress_per_kelvin_;
  TransverseShear transverse_shear_;
};

/// A laminate at a point, in orthonormal axes, with what its stresses need.
class LaminateSection {
 public:
  /// `axes`: an orthonormal_frame().
  LaminateSection(std::shared_ptr<const Laminate> laminate, const geometry::Frame& axes, double thickness,
                  double shear_correction, const InitialState& initial);

  /// Returns the stiffness, with N_0 and M_0.
  const Section& section() const { return section_; }
  std::size_t layer_count() const { return plies_.size(); }
  /// Returns the height of the interface below layer k [m].
  double interface(std::size_t k) const { return thickness_ * laminate_->interface(k); }
  /// Returns the layer that contains the height z. Of two it is the one nearer to the mid-surface.
  std::size_t layer_at(double z) const;
  /// Returns the stresses of a layer at the height z: in-plane stresses from the strains, transverse shear from
  /// equilibrium (TransverseShear).
  StressMap stress(std::size_t layer, double z) const;
  /// Returns the same in the layer's own axes.
  StressMap stress_in_layer_axes(std::size_t layer, double z) const;

 private:
  struct Ply {
    Eigen::Matrix3d stiffness;
    Vector3d initial_stress;  // at z = 0
    Vector3d initial_slope;   // its derivative by z
    Eigen::Matrix2d axes;     // the layer's axes in the section's axes
  };

  std::shared_ptr<const Laminate> laminate_;
  double thickness_;
  Eigen::Matrix2d axes_;  // the laminate's axes in the section's axes
  std::vector<Ply> plies_{};
  Section section_;
  Eigen::Matrix<double, 6, 6> compliance_;
};

}  // namespace plastron::shell

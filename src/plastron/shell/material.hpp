// The laws that give a cross-section its stiffness: an isotropic material (M7), or a laminate of orthotropic layers.
#pragma once
#include <plastron/geometry/frame.hpp>
#include <plastron/shell/laminate.hpp>
#include <plastron/shell/section.hpp>

#include <Eigen/Core>
#include <memory>
#include <variant>

namespace plastron::shell {

struct Isotropic {
  double lambda = 0;     ///< first Lame constant [Pa]
  double mu = 0;         ///< shear modulus [Pa]
  double expansion = 0;  ///< alpha, strain per temperature [1/K]

  /// Young's modulus E [Pa].
  double young() const { return mu * (3 * lambda + 2 * mu) / (lambda + mu); }
  /// The plane-stress coefficient 2 lambda mu / (lambda + 2 mu) = E nu / (1 - nu^2) [Pa].
  double lambda_plane_stress() const { return 2 * lambda * mu / (lambda + 2 * mu); }
};

struct Material {
  std::variant<Isotropic, std::shared_ptr<const Laminate>> law{};
  double shear_correction = 1;  ///< k_s: 1 in the paper, 5/6 as an option

  static Material from_young_poisson(double E, double nu, double shear_correction) {
    return {Isotropic{E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))}, shear_correction};
  }

  /// Returns the isotropic constants, or null for a laminate.
  const Isotropic* isotropic() const { return std::get_if<Isotropic>(&law); }
  /// Returns the laminate, or null for an isotropic material.
  std::shared_ptr<const Laminate> laminate() const {
    const auto* found = std::get_if<std::shared_ptr<const Laminate>>(&law);
    return found ? *found : nullptr;
  }
  /// Returns a modulus that scales penalties and tolerances: Young's modulus, or the mean of a laminate [Pa].
  double young() const { return isotropic() ? isotropic()->young() : laminate()->young(); }
  /// Whether temperatures strain the material.
  bool expands() const { return isotropic() ? isotropic()->expansion != 0 : laminate()->expands(); }
  /// Returns a modulus of transverse shear: mu, or the mean of a laminate [Pa].
  double shear_modulus() const { return isotropic() ? isotropic()->mu : laminate()->shear_modulus(); }
};

/// a^{abrs} of (M7) acting on (eps_11, eps_22, 2 eps_12), with result (sigma^11, sigma^22, sigma^12) [Pa].
Eigen::Matrix3d elasticity(const Isotropic& material, const Eigen::Matrix2d& metric_con);

/// Returns the cross-section of a thickness in the frame's contravariant components. Precondition: the direction of a
/// laminate is not normal to the surface.
Section section_at(const Material& material, const geometry::Frame& frame, double thickness,
                   const InitialState& initial = {});

/// Returns the frame of two orthonormal tangents, in which components of tensors are those in these axes.
geometry::Frame orthonormal_frame(const Vector3d& t1, const Vector3d& t2);

/// Returns the orthonormal frame whose second axis is the unit tangent of an edge.
geometry::Frame frame_across(const Vector3d& tangent, const Vector3d& a3);

}  // namespace plastron::shell

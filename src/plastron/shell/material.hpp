// Isotropic elasticity of the shell at a point (M7).
#pragma once
#include <plastron/geometry/frame.hpp>

#include <Eigen/Core>

namespace plastron::shell {

struct Material {
  double lambda = 0;            ///< first Lame constant [Pa]
  double mu = 0;                ///< shear modulus [Pa]
  double shear_correction = 1;  ///< k_s: 1 in the paper, 5/6 as an option

  static Material from_young_poisson(double E, double nu, double shear_correction) {
    return {E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu)), shear_correction};
  }
  /// Young's modulus E [Pa].
  double young() const { return mu * (3 * lambda + 2 * mu) / (lambda + mu); }
  /// The plane-stress coefficient 2 lambda mu / (lambda + 2 mu) = E nu / (1 - nu^2) [Pa].
  double lambda_plane_stress() const { return 2 * lambda * mu / (lambda + 2 * mu); }
};

/// a^{abrs} of (M7) acting on (eps_11, eps_22, 2 eps_12), with result (sigma^11, sigma^22, sigma^12) [Pa].
inline Eigen::Matrix3d elasticity(const Material& material, const Eigen::Matrix2d& metric_con) {
  constexpr int first[3] = {0, 1, 0}, second[3] = {0, 1, 1};
  const double l = material.lambda_plane_stress();
  const auto& g = metric_con;
  Eigen::Matrix3d c;
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q) {
      const int a = first[p], b = second[p], r = first[q], s = second[q];
      c(p, q) = l * g(a, b) * g(r, s) + material.mu * (g(a, r) * g(b, s) + g(a, s) * g(b, r));
    }
  return c;
}

}  // namespace plastron::shell

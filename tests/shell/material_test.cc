// Plane-stress elasticity (M7).
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "shell/random_fields.hpp"

namespace plastron::shell {
namespace {

const std::vector<double> poisson_ratios{-0.9, -0.3, 0, 0.3, 0.4999};

TEST(Material, has_the_lame_constants_of_young_and_poisson) {
  for (const double nu : poisson_ratios) {
    const Material m = Material::from_young_poisson(210, nu, 5.0 / 6);
    const Isotropic& c = *m.isotropic();
    EXPECT_DOUBLE_EQ(c.mu, 210 / (2 * (1 + nu)));
    // Uniaxial tension along 1 with strains (1, -nu, -nu): stress E along 1, none across.
    EXPECT_NEAR(c.lambda * (1 - 2 * nu) + 2 * c.mu, 210, 1e-9);
    EXPECT_NEAR(c.lambda * (1 - 2 * nu) - 2 * c.mu * nu, 0, 1e-9);
    EXPECT_EQ(m.shear_correction, 5.0 / 6);
  }
}

TEST(PlaneStressCoefficient, comes_from_no_stress_across_the_thickness) {
  // sigma_33 = 0 gives eps_33 = -lambda / (lambda + 2 mu) tr eps, and then sigma = lambda (tr eps + eps_33) + 2 mu eps.
  for (const double nu : poisson_ratios) {
    const Isotropic m = *Material::from_young_poisson(3, nu, 1).isotropic();
    EXPECT_NEAR(m.lambda_plane_stress(), m.lambda * (1 - m.lambda / (m.lambda + 2 * m.mu)),
                1e-12 * (1 + std::abs(m.lambda)));
    EXPECT_NEAR(m.lambda_plane_stress(), 3 * nu / (1 - nu * nu), 1e-12 * (1 + m.mu));
  }
}

TEST(Elasticity, is_the_tensor_of_young_and_poisson) {  // the second form of (M7)
  Random random;
  constexpr int first[3] = {0, 1, 0}, second[3] = {0, 1, 1};
  for (const double nu : poisson_ratios) {
    const double E = 2;
    const Eigen::Matrix2d g = random.metric();
    const Eigen::Matrix3d c = elasticity(*Material::from_young_poisson(E, nu, 1).isotropic(), g);
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) {
        const int a = first[p], b = second[p], r = first[q], s = second[q];
        const double expected =
            E * nu / (1 - nu * nu) * g(a, b) * g(r, s) + E / (2 * (1 + nu)) * (g(a, r) * g(b, s) + g(a, s) * g(b, r));
        EXPECT_NEAR(c(p, q), expected, 1e-13 * c.norm());
      }
  }
}

TEST(Elasticity, is_symmetric_and_positive) {
  Random random;
  for (const double nu : poisson_ratios) {
    const Eigen::Matrix3d c = elasticity(*Material::from_young_poisson(1, nu, 1).isotropic(), random.metric());
    EXPECT_LT((c - c.transpose()).norm(), 1e-15 * c.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(c).eigenvalues().minCoeff(), 0);
  }
}

TEST(Elasticity, in_cartesian_coordinates_is_hookes_law_of_plane_stress) {
  const double E = 5, nu = 0.25;
  const Eigen::Matrix3d c =
      elasticity(*Material::from_young_poisson(E, nu, 1).isotropic(), Eigen::Matrix2d::Identity());
  const Eigen::Matrix3d hooke = E / (1 - nu * nu) * Eigen::Matrix3d{{1, nu, 0}, {nu, 1, 0}, {0, 0, (1 - nu) / 2}};
  EXPECT_LT((c - hooke).norm(), 1e-14);
}

}  // namespace
}  // namespace plastron::shell

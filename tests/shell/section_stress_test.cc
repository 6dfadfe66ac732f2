// Stresses over the thickness: their integrals are the resultants, and the largest equivalent stress is correct.
#include <plastron/shell/section_stress.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plastron::shell {
namespace {

/// Resultants, different for every seed.
SectionForces some_forces(int seed) {
  auto value = [k = 0, seed]() mutable { return std::sin(1.7 * seed + 2.3 * ++k); };
  SectionForces f;
  for (Eigen::Index i = 0; i < 3; ++i) f.N[i] = value();
  for (Eigen::Index i = 0; i < 3; ++i) f.M[i] = 0.03 * value();
  for (Eigen::Index i = 0; i < 2; ++i) f.Q[i] = 2 * value();
  f.thickness = 0.1 + 0.05 * value();
  return f;
}

// Three Gauss points: exact for the quartics that occur.
template <class Function>
auto over_thickness(const SectionForces& f, const Function& function) {
  const double z = std::sqrt(0.6) * f.thickness / 2;
  return (f.thickness / 18 * (5 * function(-z) + 8 * function(0.0) + 5 * function(z))).eval();
}

TEST(SectionStress, IntegratesToTheResultants) {
  for (int seed = 0; seed < 20; ++seed) {
    const SectionForces f = some_forces(seed);
    EXPECT_LT((over_thickness(f, [&](double z) { return in_plane_stress(f, z); }) - f.N).norm(), 1e-14);
    EXPECT_LT((over_thickness(f, [&](double z) { return Vector3d(z * in_plane_stress(f, z)); }) - f.M).norm(), 1e-15);
    EXPECT_LT((over_thickness(f, [&](double z) { return shear_stress(f, z); }) - f.Q).norm(), 1e-14);
    EXPECT_LT((mean_shear_stress(f) * f.thickness - f.Q).norm(), 1e-15);
    EXPECT_LT(shear_stress(f, f.thickness / 2).norm(), 1e-14);
  }
}

TEST(SectionStress, OfABarOfVonMisesIsItsTensionAndOfShearRootThreeTimesIt) {
  EXPECT_NEAR(von_mises({5, 0, 0}, {0, 0}), 5, 1e-15);
  EXPECT_NEAR(von_mises({-5, -5, 0}, {0, 0}), 5, 1e-15);
  EXPECT_NEAR(von_mises({0, 0, 2}, {0, 0}), 2 * std::numbers::sqrt3, 1e-15);
  EXPECT_NEAR(von_mises({0, 0, 0}, {0, 2}), 2 * std::numbers::sqrt3, 1e-15);
}

TEST(SectionStress, TheLargestVonMisesIsNowhereExceededAndIsReached) {
  int inner = 0;
  for (int seed = 0; seed < 200; ++seed) {
    SectionForces f = some_forces(seed);
    if (seed % 2 == 0) f.Q *= 10;  // peaks inside
    const LargestVonMises found = largest_von_mises(f);
    double sampled = 0;
    constexpr int samples = 2000;
    for (int i = -samples; i <= samples; ++i)
      sampled = std::max(sampled, von_mises_at(f, f.thickness / 2 * i / samples));
    EXPECT_GE(found.stress, sampled * (1 - 1e-14)) << seed;
    EXPECT_LE(found.stress, sampled * (1 + 1e-5)) << seed;
    EXPECT_NEAR(von_mises_at(f, found.height), found.stress, 1e-14 * found.stress);
    if (std::abs(found.height) < 0.49 * f.thickness && std::abs(found.height) > 0.01 * f.thickness) ++inner;
  }
  EXPECT_GT(inner, 20);
  EXPECT_EQ(largest_von_mises({}).stress, 0);
}

TEST(SectionStress, PrincipalValuesAreTheTensorAlongTheirDirection) {
  for (int seed = 0; seed < 20; ++seed) {
    const Vector3d t = some_forces(seed).N;
    const Principal p = principal(t);
    const double c = std::cos(p.angle), s = std::sin(p.angle);
    EXPECT_GE(p.first, p.second);
    EXPECT_NEAR(c * c * t[0] + s * s * t[1] + 2 * c * s * t[2], p.first, 1e-14);
    EXPECT_NEAR((t[1] - t[0]) * c * s + t[2] * (c * c - s * s), 0, 1e-14);
    EXPECT_NEAR(p.first + p.second, t[0] + t[1], 1e-14);
  }
}

TEST(SectionStress, TheEnergyOfResultantsIsThatOfTheirStrains) {
  const Material steel = Material::from_young_poisson(7, 0.28, 5.0 / 6);
  const Strain<double> strain{{0.2, -0.1, 0.3}, {1.5, 0.4, -0.7}, {0.05, 0.02}};
  const double e = 0.13;
  const auto stiffness = section_at(steel, orthonormal_frame(Vector3d::UnitX(), Vector3d::UnitY()), e);
  const auto r = resultants(stiffness, strain);
  const EnergyDensity expected = energy_density(stiffness, strain);
  const EnergyDensity found = energy_density(steel, {.N = r.membrane, .M = r.bending, .Q = r.shear, .thickness = e});
  EXPECT_NEAR(found.membrane, expected.membrane, 1e-14 * expected.membrane);
  EXPECT_NEAR(found.bending, expected.bending, 1e-14 * expected.bending);
  EXPECT_NEAR(found.shear, expected.shear, 1e-14 * expected.shear);
}

}  // namespace
}  // namespace plastron::shell

// Energy density and resultants (M8): the resultants are the derivative of the energy, by automatic differentiation.
#include <gtest/gtest.h>

#include <Eigen/Core>  // AutoDiff does not include what it needs
#include <unsupported/Eigen/AutoDiff>

#include "geometry/surfaces.hpp"
#include "shell/random_fields.hpp"

namespace plastron::shell {
namespace {

const Material material = Material::from_young_poisson(2, 0.3, 5.0 / 6);

template <class Check>
void with_stiffness_at_all_points(const Check& check) {
  for (const auto& [name, chart] : geometry::surfaces()) {
    SCOPED_TRACE(name);
    for (const auto& x : geometry::sample_points()) {
      const SurfaceJet jet = chart(x[0], x[1]);
      check(jet, section_at(material, geometry::frame_at(jet), 0.1));
    }
  }
}

/// Variables of automatic differentiation, given out one after the other.
template <int size>
class Variables {
 public:
  using Scalar = Eigen::AutoDiffScalar<Eigen::Matrix<double, size, 1>>;
  template <int n>
  Eigen::Matrix<Scalar, n, 1> operator()(const Eigen::Matrix<double, n, 1>& values) {
    Eigen::Matrix<Scalar, n, 1> v;
    for (int i = 0; i < n; ++i) v[i] = Scalar(values[i], size, next_++);
    return v;
  }

 private:
  int next_ = 0;
};

TEST(Resultants, are_the_derivative_of_the_energy_by_the_strain) {
  Random random;
  with_stiffness_at_all_points([&](const SurfaceJet& jet, const Section& c) {
    const Strain<double> s = strain(random.field(), geometry::frame_at(jet));
    Variables<8> variables;
    const Strain<Variables<8>::Scalar> t{variables(s.membrane), variables(s.bending), variables(s.shear)};
    const auto energy = total_energy_density(c, t);
    const Resultants<double> n = resultants(c, s);
    Eigen::Matrix<double, 8, 1> expected;
    expected << n.membrane, n.bending, n.shear;
    EXPECT_LT((energy.derivatives() - expected).norm(), 1e-14 * (1 + expected.norm()));
    EXPECT_NEAR(energy.value(), work(n, s) / 2, 1e-14 * (1 + energy.value()));
  });
}

TEST(Dual, of_the_resultants_is_the_derivative_of_the_energy_by_the_field) {
  Random random;
  with_stiffness_at_all_points([&](const SurfaceJet& jet, const Section& c) {
    const Frame f = geometry::frame_at(jet);
    const LocalField<double> v = random.field();
    Variables<15> variables;
    LocalField<Variables<15>::Scalar> w;
    w.du = {variables(v.du[0]), variables(v.du[1])};
    w.r = variables(v.r);
    w.dr = {variables(v.dr[0]), variables(v.dr[1])};
    const auto energy = total_energy_density(c, strain(w, f));
    const LocalField<double> dual = dual_of(resultants(c, strain(v, f)), f);
    Eigen::Matrix<double, 15, 1> expected;
    expected << dual.du[0], dual.du[1], dual.r, dual.dr[0], dual.dr[1];
    EXPECT_LT((energy.derivatives() - expected).norm(), 1e-13 * (1 + expected.norm()));
  });
}

TEST(EnergyDensity, is_positive_and_the_sum_of_its_parts) {
  Random random;
  with_stiffness_at_all_points([&](const SurfaceJet& jet, const Section& c) {
    const Strain<double> s = strain(random.field(), geometry::frame_at(jet));
    const EnergyDensity e = energy_density(c, s);
    EXPECT_GT(e.membrane, 0);
    EXPECT_GT(e.bending, 0);
    EXPECT_GT(e.shear, 0);
    const double total = total_energy_density(c, s);
    EXPECT_NEAR(e.membrane + e.bending + e.shear, total, 1e-14 * total);
  });
}

TEST(EnergyDensity, of_a_rigid_motion_is_zero) {
  Random random;
  with_stiffness_at_all_points([&](const SurfaceJet& jet, const Section& c) {
    const Frame f = geometry::frame_at(jet);
    EXPECT_LT(total_energy_density(c, strain(rigid_motion(f, random.vector()), f)), 1e-26);
  });
}

TEST(EnergyDensity, does_not_depend_on_the_coordinates) {
  Random random;
  const geometry::PlaneJet change{
      .value = {},
      .d = {Eigen::Vector2d(0.8, 0.3), Eigen::Vector2d(-0.4, 1.3)},
      .dd = {Eigen::Vector2d(0.2, -0.5), Eigen::Vector2d(0.7, 0.1), Eigen::Vector2d(-0.3, 0.4)}};
  Eigen::Matrix2d J;
  J << change.d[0], change.d[1];
  with_stiffness_at_all_points([&](const SurfaceJet& jet, const Section& c) {
    const Frame f = geometry::frame_at(jet), g = geometry::frame_at(geometry::compose(jet, change));
    const LocalField<double> v = random.field();
    const EnergyDensity here = energy_density(c, strain(v, f));
    const EnergyDensity there = energy_density(section_at(material, g, 0.1), strain(in_coordinates(v, J), g));
    EXPECT_NEAR(here.membrane, there.membrane, 1e-12 * here.membrane);
    EXPECT_NEAR(here.bending, there.bending, 1e-12 * here.bending);
    EXPECT_NEAR(here.shear, there.shear, 1e-12 * here.shear);
  });
}

TEST(Section, grows_with_the_thickness_as_a_plates_does) {
  const Frame frame = geometry::frame_at({.value = {}, .d = {Vector3d(1, 0.3, 0), Vector3d(-0.2, 1.4, 0.5)}, .dd = {}});
  const Section thin = section_at(material, frame, 0.1), thick = section_at(material, frame, 0.2);
  EXPECT_LT((thick.membrane - 2 * thin.membrane).norm(), 1e-15 * thick.membrane.norm());
  EXPECT_LT((thick.bending - 8 * thin.bending).norm(), 1e-15 * thick.bending.norm());
  EXPECT_LT((thick.shear - 2 * thin.shear).norm(), 1e-15 * thick.shear.norm());
  EXPECT_FALSE(thin.is_coupled());
  // 4 k_s e mu delta^2 with the stored strain 2 delta: the matrix is k_s e mu.
  EXPECT_LT((thin.shear - 5.0 / 6 * 0.1 * material.shear_modulus() * frame.metric_con).norm(), 1e-16);
}

}  // namespace
}  // namespace plastron::shell

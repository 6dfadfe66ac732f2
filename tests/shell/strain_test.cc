// The strains (M4-M6): their invariances, their values for known fields, and their transposes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/surfaces.hpp"
#include "shell/random_fields.hpp"

namespace plastron::shell {
namespace {

template <class Check>
void at_all_points(const Check& check) {
  for (const auto& [name, chart] : geometry::surfaces()) {
    SCOPED_TRACE(name);
    for (const auto& x : geometry::sample_points()) check(geometry::frame_at(chart(x[0], x[1])));
  }
}

double scale(const Frame& f) { return 1 + f.a_cov[0].squaredNorm() + f.a_cov[1].squaredNorm() + f.b_cov.norm(); }

TEST(RigidMotion, gives_no_strain) {  // (M4), (M5), (M6)
  Random random;
  at_all_points([&](const Frame& f) {
    const Strain<double> s = strain(rigid_motion(f, 10 * random.vector()), f);
    const double rounding = 1e-14 * scale(f);
    EXPECT_LT(s.membrane.norm(), rounding);
    EXPECT_LT(s.bending.norm(), rounding);
    EXPECT_LT(s.shear.norm(), rounding);
  });
}

TEST(Strain,
     of_a_field_is_that_of_the_definition) {  // (M4), (M5), (M6), with the factor 2 of mixed and shear components
  Random random;
  at_all_points([&](const Frame& f) {
    const LocalField<double> v = random.field();
    const Strain<double> s = strain(v, f);
    const auto gamma = [&](int a, int b) { return (v.du[a].dot(f.a_cov[b]) + v.du[b].dot(f.a_cov[a])) / 2; };
    const auto chi = [&](int a, int b) {
      return (v.du[a].dot(f.da3[b]) + v.du[b].dot(f.da3[a]) + v.dr[a].dot(f.a_cov[b]) + v.dr[b].dot(f.a_cov[a])) / 2;
    };
    const Vector3d membrane(gamma(0, 0), gamma(1, 1), 2 * gamma(0, 1)), bending(chi(0, 0), chi(1, 1), 2 * chi(0, 1));
    EXPECT_LT((s.membrane - membrane).norm(), 1e-14 * scale(f));
    EXPECT_LT((s.bending - bending).norm(), 1e-14 * scale(f));
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(s.shear[a], v.du[a].dot(f.a3) + v.r.dot(f.a_cov[a]), 1e-14 * scale(f));
  });
}

TEST(Strain, of_growth_is_the_metric) {  // u = phi, r = 0 stretches every length by the same factor: gamma = a_cov
  at_all_points([&](const Frame& f) {
    const LocalField<double> growth{{f.a_cov[0], f.a_cov[1]}, Vector3d::Zero(), {Vector3d::Zero(), Vector3d::Zero()}};
    const Strain<double> s = strain(growth, f);
    const Vector3d metric(f.metric_cov(0, 0), f.metric_cov(1, 1), 2 * f.metric_cov(0, 1));
    EXPECT_LT((s.membrane - metric).norm(), 1e-14 * scale(f));
    EXPECT_LT(s.shear.norm(), 1e-14 * scale(f));
  });
}

TEST(Strain, of_an_inflated_sphere_is_pure_growth) {
  // u = a_3 (outward), r = 0: gamma = -b, which is metric / R on a sphere; chi = a_3,a . a_3,b = metric / R^2.
  const double R = 1.5;
  const geometry::Chart sphere({"R*sin(x)*cos(y)", "R*sin(y)", "R*cos(x)*cos(y)"}, {{"R", R}});
  for (const auto& x : geometry::sample_points()) {
    const Frame f = geometry::frame_at(sphere(x[0], x[1]));
    const LocalField<double> v{{f.da3[0], f.da3[1]}, Vector3d::Zero(), {Vector3d::Zero(), Vector3d::Zero()}};
    const Strain<double> s = strain(v, f);
    const Vector3d metric(f.metric_cov(0, 0), f.metric_cov(1, 1), 2 * f.metric_cov(0, 1));
    EXPECT_LT((s.membrane - metric / R).norm(), 1e-14);
    EXPECT_LT((s.bending - metric / (R * R)).norm(), 1e-14);
    EXPECT_LT(s.shear.norm(), 1e-14);
  }
}

LocalField<double> sum(const LocalField<double>& v, double factor, const LocalField<double>& w) {
  LocalField<double> s = v;
  s.r += factor * w.r;
  for (std::size_t a = 0; a < 2; ++a) {
    s.du[a] += factor * w.du[a];
    s.dr[a] += factor * w.dr[a];
  }
  return s;
}

Strain<double> finite_strain(const LocalField<double>& v, const Frame& f) {
  return strain(v, deformed(f, sum(v, -0.5, v)));
}

TEST(FiniteStrain, of_a_field_is_that_of_the_definition) {  // (M24), (M25), (M26)
  Random random;
  at_all_points([&](const Frame& f) {
    const LocalField<double> v = random.field();
    const Strain<double> s = finite_strain(v, f);
    const Frame now = deformed(f, v);
    const auto gamma = [&](int a, int b) { return (now.a_cov[a].dot(now.a_cov[b]) - f.metric_cov(a, b)) / 2; };
    const auto chi = [&](int a, int b) {
      return (now.a_cov[a].dot(now.da3[b]) + now.a_cov[b].dot(now.da3[a]) - f.a_cov[a].dot(f.da3[b]) -
              f.a_cov[b].dot(f.da3[a])) /
             2;
    };
    const double rounding = 1e-13 * scale(f);
    EXPECT_LT((s.membrane - Vector3d(gamma(0, 0), gamma(1, 1), 2 * gamma(0, 1))).norm(), rounding);
    EXPECT_LT((s.bending - Vector3d(chi(0, 0), chi(1, 1), 2 * chi(0, 1))).norm(), rounding);
    for (int a = 0; a < 2; ++a) EXPECT_NEAR(s.shear[a], now.a_cov[a].dot(now.a3), rounding);
  });
}

TEST(FiniteStrain, has_the_strain_at_the_state_as_its_derivative) {
  Random random;
  at_all_points([&](const Frame& f) {
    const LocalField<double> v = random.field(), w = random.field();
    const Strain<double> ahead = finite_strain(sum(v, 1, w), f), behind = finite_strain(sum(v, -1, w), f),
                         derivative = strain(w, deformed(f, v));
    const double rounding = 1e-13 * scale(f);
    EXPECT_LT(((ahead.membrane - behind.membrane) / 2 - derivative.membrane).norm(), rounding);
    EXPECT_LT(((ahead.bending - behind.bending) / 2 - derivative.bending).norm(), rounding);
    EXPECT_LT(((ahead.shear - behind.shear) / 2 - derivative.shear).norm(), rounding);
  });
}

TEST(FiniteStrain, of_a_rotation_by_any_angle_is_zero) {
  at_all_points([&](const Frame& f) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(2.5, Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix() - Eigen::Matrix3d::Identity();
    const Strain<double> s =
        finite_strain({{turn * f.a_cov[0], turn * f.a_cov[1]}, turn * f.a3, {turn * f.da3[0], turn * f.da3[1]}}, f);
    EXPECT_LT(s.membrane.norm() + s.bending.norm() + s.shear.norm(), 1e-13 * scale(f));
  });
}

TEST(Dual, is_the_transpose_of_the_strain) {
  Random random;
  at_all_points([&](const Frame& f) {
    const Resultants<double> n{random.vector(), random.vector(), random.vector().head<2>()};
    const LocalField<double> v = random.field();
    EXPECT_NEAR(work(dual_of(n, f), v), work(n, strain(v, f)), 1e-14 * scale(f) * 10);
  });
}

TEST(Dual, does_no_work_on_rigid_motions) {
  Random random;
  at_all_points([&](const Frame& f) {
    const LocalField<double> dual = dual_of({random.vector(), random.vector(), random.vector().head<2>()}, f);
    EXPECT_NEAR(work(dual, rigid_motion(f, random.vector())), 0, 1e-14 * scale(f) * 10);
  });
}

}  // namespace
}  // namespace plastron::shell

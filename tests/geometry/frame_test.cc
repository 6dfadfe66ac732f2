// The local frame (M1-M3) on surfaces with curvature of every kind.
#include <gtest/gtest.h>
#include <plastron/geometry/frame.hpp>

#include <cmath>

#include "geometry/finite_differences.hpp"
#include "geometry/surfaces.hpp"

namespace plastron::geometry {
namespace {

template <class Check>
void at_all_points(const Check& check) {
  for (const auto& [name, chart] : surfaces()) {
    SCOPED_TRACE(name);
    for (const Vector2d& x : sample_points()) check(chart, x);
  }
}

/// A curved change of coordinates around the point x: the jet of (s, t) -> (x, y) at (0, 0).
PlaneJet curved_coordinates(const Vector2d& x) {
  return {.value = x,
          .d = {Vector2d(0.8, 0.3), Vector2d(-0.4, 1.3)},
          .dd = {Vector2d(0.2, -0.5), Vector2d(0.7, 0.1), Vector2d(-0.3, 0.4)}};
}

TEST(Frame, dual_vectors_are_dual) {  // (M1)
  at_all_points([](const Chart& chart, const Vector2d& x) {
    const Frame f = frame_at(chart(x[0], x[1]));
    for (std::size_t a = 0; a < 2; ++a) {
      for (std::size_t b = 0; b < 2; ++b) EXPECT_NEAR(f.a_con[a].dot(f.a_cov[b]), a == b, 1e-14);
      EXPECT_NEAR(f.a_con[a].dot(f.a3), 0, 1e-14);
    }
    EXPECT_LT((f.metric_con * f.metric_cov - Matrix2d::Identity()).norm(), 1e-14);
  });
}

TEST(Frame, normal_is_a_unit_vector_on_the_positive_side_of_the_tangents) {  // (M1)
  at_all_points([](const Chart& chart, const Vector2d& x) {
    const SurfaceJet jet = chart(x[0], x[1]);
    const Frame f = frame_at(jet);
    EXPECT_NEAR(f.a3.norm(), 1, 1e-15);
    for (const Vector3d& a : f.a_cov) EXPECT_NEAR(f.a3.dot(a), 0, 1e-15 * a.norm());
    EXPECT_GT(f.a_cov[0].cross(f.a_cov[1]).dot(f.a3), 0);
    EXPECT_LT((unit_normal(jet) - f.a3).norm(), 1e-15);
  });
}

TEST(Frame, area_element_is_the_root_of_the_metrics_determinant) {  // (M2)
  at_all_points([](const Chart& chart, const Vector2d& x) {
    const Frame f = frame_at(chart(x[0], x[1]));
    EXPECT_NEAR(f.sqrt_a * f.sqrt_a, f.metric_cov.determinant(), 1e-14 * f.sqrt_a * f.sqrt_a);
  });
}

TEST(Frame, derivative_of_the_normal_agrees_with_finite_differences) {  // (M3)
  at_all_points([](const Chart& chart, const Vector2d& x) {
    const Frame f = frame_at(chart(x[0], x[1]));
    const Vector3d d1 = derivative([&](double s) -> Vector3d { return unit_normal(chart(s, x[1])); }, x[0]);
    const Vector3d d2 = derivative([&](double t) -> Vector3d { return unit_normal(chart(x[0], t)); }, x[1]);
    EXPECT_LT((f.da3[0] - d1).norm(), 1e-6);
    EXPECT_LT((f.da3[1] - d2).norm(), 1e-6);
  });
}

TEST(Frame, second_fundamental_form_is_symmetric_and_both_its_definitions_agree) {  // (M2), (M3)
  at_all_points([](const Chart& chart, const Vector2d& x) {
    const Frame f = frame_at(chart(x[0], x[1]));
    EXPECT_EQ(f.b_cov(0, 1), f.b_cov(1, 0));
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) EXPECT_NEAR(-f.a_cov[a].dot(f.da3[b]), f.b_cov(a, b), 1e-13);
    for (const Vector3d& d : f.da3) EXPECT_NEAR(d.dot(f.a3), 0, 1e-13);
  });
}

TEST(Curvature, of_a_plane_is_zero) {
  for (const Vector2d& x : sample_points())
    for (const double kappa : principal_curvatures(frame_at(surfaces()[1].chart(x[0], x[1])))) EXPECT_EQ(kappa, 0);
}

TEST(Curvature, of_a_cylinder_is_zero_and_that_of_its_circle) {
  const Chart chart({"R*sin(x/R)", "y", "R*cos(x/R)"}, {{"R", 1.5}});
  const auto kappa = principal_curvatures(frame_at(chart(0.3, 0.4)));
  EXPECT_NEAR(kappa[0], -1 / 1.5, 1e-15);  // a_3 points away from the axis
  EXPECT_NEAR(kappa[1], 0, 1e-15);
}

TEST(Curvature, of_a_sphere_is_the_same_in_all_directions_and_all_charts) {
  for (const std::size_t which : {3, 4})
    for (const Vector2d& x : sample_points())
      for (const double kappa : principal_curvatures(frame_at(surfaces()[which].chart(x[0], x[1]))))
        EXPECT_NEAR(std::abs(kappa), 1 / 1.5, 1e-7);  // the root of a cancelling difference: half of the digits
}

TEST(Curvature, of_a_saddle_has_both_signs) {
  const auto kappa = principal_curvatures(frame_at(Chart({"x", "y", "x^2 - y^2"}, {})(0, 0)));
  EXPECT_DOUBLE_EQ(kappa[0], -2);
  EXPECT_DOUBLE_EQ(kappa[1], 2);
}

TEST(Curvature, does_not_depend_on_the_coordinates) {
  at_all_points([](const Chart& chart, const Vector2d& x) {
    const SurfaceJet jet = chart(x[0], x[1]);
    const Frame f = frame_at(jet), g = frame_at(compose(jet, curved_coordinates(x)));
    const auto k = principal_curvatures(f), l = principal_curvatures(g);
    EXPECT_LT((f.a3 - g.a3).norm(), 1e-14);
    EXPECT_NEAR(k[0] + k[1], l[0] + l[1], 1e-12);
    EXPECT_NEAR(k[0] * k[1], l[0] * l[1], 1e-12);
  });
}

TEST(Frame, changes_with_the_coordinates_like_tensors) {
  at_all_points([](const Chart& chart, const Vector2d& x) {
    const PlaneJet change = curved_coordinates(x);
    const SurfaceJet jet = chart(x[0], x[1]);
    const Frame f = frame_at(jet), g = frame_at(compose(jet, change));
    Matrix2d J;
    J << change.d[0], change.d[1];
    EXPECT_LT((g.metric_cov - J.transpose() * f.metric_cov * J).norm(), 1e-13);
    EXPECT_LT((g.b_cov - J.transpose() * f.b_cov * J).norm(), 1e-12);
    EXPECT_NEAR(g.sqrt_a, f.sqrt_a * J.determinant(), 1e-14 * g.sqrt_a * 10);
  });
}

TEST(Composition, follows_the_chain_rule) {
  const Chart chart = surfaces().back().chart;
  const Vector2d x(0.2, -0.1);
  const PlaneJet change = curved_coordinates(x);
  const auto moved = [&](double s, double t) -> Vector3d {
    const Vector2d p = change.value + s * change.d[0] + t * change.d[1] + s * s / 2 * change.dd[0] +
                       s * t * change.dd[1] + t * t / 2 * change.dd[2];
    return chart(p[0], p[1]).value;
  };
  EXPECT_LT(distance(compose(chart(x[0], x[1]), change), jet_by_differences<Vector3d>(moved, {0, 0})), 1e-8);
}

double sine_of(const SurfaceJet& phi) { return tangent_sine(frame_at(phi)); }

TEST(TangentSine, is_zero_exactly_where_the_tangents_are_parallel) {
  EXPECT_EQ(sine_of(Chart({"x + y", "x + y", "0"}, {})(0.3, 0.4)), 0);
  EXPECT_EQ(sine_of(surfaces()[0].chart(0.3, 0.4)), 1);
  EXPECT_FALSE(sine_of(Chart({"x*cos(y)", "x*sin(y)", "0"}, {})(0, 0.4)) >
               degenerate_sine);  // NaN counts as degenerate
  // The sine does not depend on the lengths of the tangents.
  EXPECT_NEAR(sine_of(Chart({"1e-6*x", "1e5*y", "0"}, {})(0, 0)), 1, 1e-15);
}

}  // namespace
}  // namespace plastron::geometry

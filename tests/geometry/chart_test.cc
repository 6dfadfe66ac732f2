// The jet of phi: derivatives against finite differences and against formulas by hand, and expressions that cannot be charts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/finite_differences.hpp"
#include "geometry/surfaces.hpp"

namespace plastron::geometry {
namespace {

using testing::HasSubstr;

/// The jet of a chart (x, y, f), or of one that has the component f in all three places.
SurfaceJet jet_of(const std::string& f, double x, double y, const Constants& constants = {}) {
  return Chart({f, f, f}, constants)(x, y);
}

std::string refusal(const std::array<std::string, 3>& components) {
  try {
    const Chart chart(components, {});
  } catch (const ExpressionError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(Chart, derivatives_agree_with_finite_differences) {
  for (const auto& [name, chart] : surfaces()) {
    SCOPED_TRACE(name);
    for (const Vector2d& x : sample_points()) {
      const auto differences =
          jet_by_differences<Vector3d>([&at = chart](double s, double t) { return at(s, t).value; }, x);
      EXPECT_LT(distance(chart(x[0], x[1]), differences), 2e-7);
    }
  }
}

TEST(Chart, derivatives_of_every_function_agree_with_finite_differences) {
  for (const std::string f : {"sin(x*y)",      "cos(x + y^2)",    "tan(x/2 - y)",        "asin(x/2)*y",
                              "acos(y/2)*x",   "atan(x - 2*y)",   "atan2(1 + y, 2 + x)", "sinh(x)*y",
                              "cosh(x*y)",     "tanh(x + y)",     "exp(x - y^2)",        "log(2 + x + y)",
                              "sqrt(2 + x*y)", "abs(x - 3)*y",    "abs(x + 3)^3",        "1/(2 + x)^2",
                              "(3 + x)^y",     "(2 + x + y)^1.5", "(2 + x)^2.5",         "(2 + y)^-0.5",
                              "2^x",           "x^3*y^4"}) {
    SCOPED_TRACE(f);
    const Chart chart({f, f, f}, {});
    const auto differences =
        jet_by_differences<Vector3d>([&](double s, double t) { return chart(s, t).value; }, {0.31, 0.17});
    EXPECT_LT(distance(chart(0.31, 0.17), differences), 1e-7);
  }
}

TEST(Chart, displaced_along_the_normal_of_a_cylinder_has_another_radius) {
  const Constants c{{"R", 2}};
  const Chart by_hand({"(R + 0.1*sin(3*x)*y)*cos(x)", "(R + 0.1*sin(3*x)*y)*sin(x)", "y"}, c);
  const Chart displaced({"R*cos(x)", "R*sin(x)", "y"}, c,
                        {{.normal = "0.04*sin(3*x)*y"}, {.normal = "0.06*sin(3*x)*y"}});
  for (const Vector2d& x : sample_points()) EXPECT_LT(distance(displaced(x[0], x[1]), by_hand(x[0], x[1])), 1e-12) << x;
}

TEST(Chart, displaced_along_the_normal_of_a_sphere_has_another_radius) {
  const Constants c{{"R", 3}};
  const std::array<std::string, 3> sphere{"x", "y", "sqrt(R^2 - x^2 - y^2)"};
  const Chart displaced(sphere, c, {{.cartesian = {"0", "0", "x*y"}, .normal = "0.3 + 0.1*cos(x)"}});
  const std::string ratio = "(1 + (0.3 + 0.1*cos(x))/R)";
  const Chart by_hand({"x*" + ratio, "y*" + ratio, "x*y + sqrt(R^2 - x^2 - y^2)*" + ratio}, c);
  for (const Vector2d& x : sample_points()) EXPECT_LT(distance(displaced(x[0], x[1]), by_hand(x[0], x[1])), 1e-11) << x;
}

TEST(Chart, is_not_displaced_by_what_has_no_derivatives) {
  EXPECT_THROW(Chart({"x", "y", "0"}, {}, {{.normal = "x > 0 ? 1 : 0"}}), NotDifferentiable);
  EXPECT_THROW(Chart({"x", "y", "0"}, {}, {{.cartesian = {"0", "0", "X"}}}), NotDifferentiable);
}

TEST(Chart, values_are_those_of_the_plain_expression) {
  const Constants c{{"R", 2}, {"minus", -1.5}, {"_k", 0.25}, {"c", 0}};
  for (const std::string f : {"-x^2",
                              "2^-1*x",
                              "x - y - 1",
                              "x/y/2",
                              "2^x^y",
                              "-x*-y",
                              "(-x)^2",
                              "1 - -x",
                              "1e-3*x",
                              ".5*x + 1.*y",
                              "x^0",
                              "x^(1/2)",
                              "sqrt(x^2)",
                              "R^2*x/R",
                              "abs(minus)*x",
                              "sqrt(minus^2)*x",
                              "(minus^2)^(3/2)*x",
                              "_k*x",
                              "pi*x",
                              "+x",
                              "2*3^2",
                              "x*(y)",
                              "2--x^2",
                              "2^-x^2*y",
                              "x^-y*2",
                              "-x^-2",
                              "-2^2*x",
                              "x-y--2",
                              "1e-3^2*y",
                              "2E+1*x",
                              "atan2(x,-y)",
                              " ( x ) ^ 2 / - y ",
                              "c*0 + minus*x",
                              "abs(c - x)",
                              "log(1 + c + x)"}) {
    SCOPED_TRACE(f);
    const double expected = Expression(f, c)(0.3, 0.7);
    EXPECT_NEAR(jet_of(f, 0.3, 0.7, c).value[0], expected, 1e-15 * (1 + std::abs(expected)));
  }
}

TEST(Chart, of_a_cylinder_is_the_jet_derived_by_hand) {
  const double R = 1.5, x = 0.4, s = std::sin(x / R), c = std::cos(x / R);
  const SurfaceJet jet = Chart({"R*sin(x/R)", "y", "R*cos(x/R)"}, {{"R", R}})(x, 2);
  const SurfaceJet exact{.value = {R * s, 2, R * c},
                         .d = {Vector3d(c, 0, -s), Vector3d(0, 1, 0)},
                         .dd = {Vector3d(-s / R, 0, -c / R), Vector3d::Zero(), Vector3d::Zero()}};
  EXPECT_LT(distance(jet, exact), 1e-15);
}

TEST(Chart, of_a_sphere_is_the_jet_derived_by_hand) {
  const double R = 2, x = 0.6, y = -0.3, z = std::sqrt(R * R - x * x - y * y), z3 = z * z * z;
  const SurfaceJet jet = Chart({"x", "y", "-sqrt(R^2 - x^2 - y^2)"}, {{"R", R}})(x, y);
  const SurfaceJet exact{
      .value = {x, y, -z},
      .d = {Vector3d(1, 0, x / z), Vector3d(0, 1, y / z)},
      .dd = {Vector3d(0, 0, (z * z + x * x) / z3), Vector3d(0, 0, x * y / z3), Vector3d(0, 0, (z * z + y * y) / z3)}};
  EXPECT_LT(distance(jet, exact), 2e-15);
}

TEST(Chart, of_a_hyperbolic_paraboloid_is_the_jet_derived_by_hand) {
  const SurfaceJet jet = Chart({"x", "y", "x^2 - y^2 + 3*x*y"}, {})(0.5, 0.25);
  const SurfaceJet exact{.value = {0.5, 0.25, 0.5625},
                         .d = {Vector3d(1, 0, 1.75), Vector3d(0, 1, 1)},
                         .dd = {Vector3d(0, 0, 2), Vector3d(0, 0, 3), Vector3d(0, 0, -2)}};
  EXPECT_EQ(distance(jet, exact), 0);
}

TEST(Chart, of_a_hat_is_the_jet_derived_by_hand) {
  const double h = 0.05, a = 0.5, x = 0.3, y = 0.2, q = (x * x + y * y) / (a * a) - 1;
  const SurfaceJet jet = Chart({"x", "y", "h*((x^2 + y^2)/a^2 - 1)^2"}, {{"h", h}, {"a", a}})(x, y);
  const double slope = 4 * h / (a * a), twist = 8 * h / std::pow(a, 4);
  const SurfaceJet exact{.value = {x, y, h * q * q},
                         .d = {Vector3d(1, 0, slope * q * x), Vector3d(0, 1, slope * q * y)},
                         .dd = {Vector3d(0, 0, slope * q + twist * x * x), Vector3d(0, 0, twist * x * y),
                                Vector3d(0, 0, slope * q + twist * y * y)}};
  EXPECT_LT(distance(jet, exact), 1e-15);
}

TEST(Chart, differentiates_atan2_abs_and_exp_by_the_known_formulas) {
  const double x = 0.8, y = -0.6, rr = x * x + y * y;
  const SurfaceJet angle = jet_of("atan2(y, x)", x, y);
  EXPECT_NEAR(angle.value[0], std::atan2(y, x), 1e-15);
  EXPECT_NEAR(angle.d[0][0], -y / rr, 1e-15);
  EXPECT_NEAR(angle.d[1][0], x / rr, 1e-15);
  EXPECT_NEAR(angle.dd[1][0], (y * y - x * x) / (rr * rr), 1e-15);
  EXPECT_NEAR(jet_of("atan2(y, x)", -1, 0.5).value[0], std::atan2(0.5, -1), 1e-15);  // the right branch
  for (const double s : {-2.0, 2.0}) {
    const SurfaceJet size = jet_of("abs(x)", s, 0);
    EXPECT_EQ(size.value[0], 2);
    EXPECT_EQ(size.d[0][0], s / 2);
    EXPECT_EQ(size.dd[0][0], 0);
  }
  // Both derivatives exist where x |x| is zero.
  const SurfaceJet signed_square = jet_of("x*abs(x)", 0, 0);
  EXPECT_EQ(signed_square.value[0], 0);
  EXPECT_EQ(signed_square.d[0][0], 0);
  EXPECT_EQ(signed_square.dd[0][0], 0);
  EXPECT_EQ(jet_of("x*abs(x)", -3, 0).dd[0][0], -2);
  const SurfaceJet growth = jet_of("exp(2*x)", 0.5, 0);
  EXPECT_DOUBLE_EQ(growth.dd[0][0], 4 * std::exp(1.0));
}

TEST(Chart, in_which_terms_cancel_is_exactly_zero) {
  const Constants c{{"R", 0.1}, {"S", 0.3}};
  for (const std::string f : {"R - R", "S*x - S*x", "R/3 - R/3", "(R + S) - S - R", "R*S*x - S*R*x"})
    for (const Vector2d& x : sample_points()) EXPECT_EQ(distance(jet_of(f, x[0], x[1], c), SurfaceJet{}), 0) << f;
}

TEST(Chart, that_is_affine_has_no_second_derivatives_at_all) {
  const Chart chart({"0.1*x + 0.7*y", "y/3", "0.3*(x + y)"}, {});
  for (const Vector2d& x : sample_points())
    for (const Vector3d& dd : chart(x[0], x[1]).dd) EXPECT_EQ(dd.norm(), 0);
}

TEST(Chart, evaluates_many_points_like_single_ones_and_second_derivatives_only_when_asked) {
  const Chart chart = surfaces().back().chart;
  std::vector<double> x, y;
  for (const Vector2d& p : sample_points()) x.push_back(p[0]), y.push_back(p[1]);
  std::vector<SurfaceJet> with(x.size()), without(x.size());
  chart.evaluate(x, y, with);
  chart.evaluate(x, y, without, false);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(distance(with[i], chart(x[i], y[i])), 0);
    EXPECT_EQ(without[i].d[1], with[i].d[1]);
    EXPECT_EQ(without[i].dd[0].norm(), 0);
  }
}

TEST(WrongChart, without_two_derivatives_is_told_what_charts_allow) {
  for (const std::string f : {"x < 0 ? 1 : x", "min(x, y)", "max(x, 0)", "x > y", "sign(x)", "(x > 0)*x"}) {
    const std::string message = refusal({"x", "y", f});
    EXPECT_THAT(message, HasSubstr(f));
    EXPECT_THAT(message, HasSubstr("charts allow"));
  }
}

TEST(WrongChart, that_is_no_expression_is_refused_as_an_expression) {
  EXPECT_THAT(refusal({"x", "y", "x + foo"}), HasSubstr("unknown name \"foo\""));
  EXPECT_THAT(refusal({"x", "y +", "0"}), HasSubstr("ends too early"));
}

TEST(Chart, whose_derivatives_would_be_too_long_says_why) {
  const auto reason_of = [](const std::string& formula) {
    try {
      const Chart chart({"x", "y", formula}, {});
    } catch (const NotDifferentiable& error) {
      return error.reason;
    }
    return std::string();
  };
  std::string product = "x";
  for (int i = 1; i < 300; ++i) product += "*(x+" + std::to_string(i) + ")";
  EXPECT_NE(reason_of(product).find("second derivatives are too long"), std::string::npos);
  EXPECT_NE(reason_of("9^9^9*x").find("exponent"), std::string::npos);
  EXPECT_NE(reason_of("((9*x)^1000)^1000").find("digits"), std::string::npos);
  EXPECT_NE(reason_of("max(x, y)").find("\"max\" has no derivatives"), std::string::npos);
}

TEST(Chart, may_have_terms_by_the_hundred) {
  std::string sum = "0";
  for (int i = 1; i <= 10; ++i)
    for (int j = 1; j <= 12; ++j) sum += "+x^" + std::to_string(i) + "*y^" + std::to_string(j) + "*sin(x)";
  EXPECT_NO_THROW(Chart({"x", "y", sum}, {}));
}

}  // namespace
}  // namespace plastron::geometry

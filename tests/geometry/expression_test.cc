// Expressions that a user may write in place of a number, and the messages about wrong ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/geometry/expression.hpp>
#include <plastron/geometry/pieces.hpp>
#include <plastron/geometry/quotation.hpp>

#include <cmath>
#include <functional>
#include <numbers>

namespace plastron::geometry {
namespace {

using testing::HasSubstr;

ExpressionError error_of(const std::string& text, const Constants& constants = {}) {
  try {
    const Expression e(text, constants);
  } catch (const ExpressionError& error) {
    return error;
  }
  ADD_FAILURE() << text << " was accepted";
  return {"", 0};
}

TEST(Expression, can_be_scaled_once_and_again) {
  const Expression f("1 + x*y", {}), twice = f.scaled(2), sixfold = twice.scaled(3),
                                     constant = Expression(4).scaled(0.5);
  EXPECT_DOUBLE_EQ(f(2, 3), 7);
  EXPECT_DOUBLE_EQ(twice(2, 3), 14);
  EXPECT_DOUBLE_EQ(sixfold(2, 3), 42);
  EXPECT_DOUBLE_EQ(constant(2, 3), 2);
  EXPECT_TRUE(constant.is_constant());
  const std::vector<Place> places{{2, 3}, {0, 1}};
  std::vector<double> values(2);
  sixfold.evaluate(places, values);
  EXPECT_DOUBLE_EQ(values[0], 42);
  EXPECT_DOUBLE_EQ(values[1], 6);
}

TEST(Expression, has_the_value_of_the_formula) {
  struct Case {
    std::string text;
    std::function<double(double, double)> value;
  };
  const double R = 2.5;
  const std::vector<Case> cases{
      {"x + 2*y", [](double x, double y) { return x + 2 * y; }},
      {"-x^2", [](double x, double) { return -x * x; }},
      {"2^-1*x", [](double x, double) { return x / 2; }},
      {"x - y - 1", [](double x, double y) { return x - y - 1; }},
      {"x/y/2", [](double x, double y) { return x / y / 2; }},
      {"2^x^y", [](double x, double y) { return std::pow(2, std::pow(x, y)); }},
      {"R*sin(x/R)*cos(y) - tan(x)",
       [=](double x, double y) { return R * std::sin(x / R) * std::cos(y) - std::tan(x); }},
      {"asin(x) + acos(y) + atan(x)", [](double x, double y) { return std::asin(x) + std::acos(y) + std::atan(x); }},
      {"atan2(y, x - 1)", [](double x, double y) { return std::atan2(y, x - 1); }},
      {"sinh(x) + cosh(y) + tanh(x*y)",
       [](double x, double y) { return std::sinh(x) + std::cosh(y) + std::tanh(x * y); }},
      {"exp(x)*log(y)", [](double x, double y) { return std::exp(x) * std::log(y); }},
      {"sqrt(y)*abs(x - 1)", [](double x, double y) { return std::sqrt(y) * std::abs(x - 1); }},
      {"min(x, y) + max(x, y, 0.5)",
       [](double x, double y) {
         return std::min(x, y) + std::max({x, y, 0.5});
       }},
      {"sign(x - y) + sign(0) ", [](double x, double y) { return x > y   ? 1.0
                                                                 : x < y ? -1.0
                                                                         : 0.0; }},
      {"x < y ? x : 3*y", [](double x, double y) { return x < y ? x : 3 * y; }},
      {"(x > 0.2 && y <= 0.6) ? 1 : 0", [](double x, double y) { return x > 0.2 && y <= 0.6 ? 1.0 : 0.0; }},
      {"(x == y || x >= 0.3) ? 1 : 0", [](double x, double y) { return x == y || x >= 0.3 ? 1.0 : 0.0; }},
      {"x != y ? 1e-3 : .5", [](double x, double y) { return x != y ? 1e-3 : 0.5; }},
      {"pi*x", [](double x, double) { return std::numbers::pi * x; }}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const Expression e(c.text, {{"R", R}});
    EXPECT_FALSE(e.is_constant());
    EXPECT_EQ(e.text(), c.text);
    for (const auto& [x, y] : {std::pair{0.25, 0.75}, {0.5, 0.5}, {0.75, 0.125}})
      EXPECT_NEAR(e(x, y), c.value(x, y), 4e-16 * (1 + std::abs(c.value(x, y))));
  }
}

TEST(Expression, KnowsThePlaceInSpace) {
  const Expression depth("9.81*(h - Z)", {{"h", 2}}), both("x + Y", {}), plane("x*y", {});
  EXPECT_DOUBLE_EQ(depth({.Z = 0.5}), 9.81 * 1.5);
  EXPECT_DOUBLE_EQ(both({.x = 1, .Y = 2}), 3);
  EXPECT_TRUE(depth.uses_space() && !depth.uses_parameters());
  EXPECT_TRUE(both.uses_space() && both.uses_parameters());
  EXPECT_TRUE(!plane.uses_space() && plane.uses_parameters());
  EXPECT_TRUE(Pieces(Expression("Z < 1", {})).is_one_over({.Z = {0, 0.5}}));
  EXPECT_FALSE(Pieces(Expression("Z < 1", {})).is_one_over({.Z = {0, 1.5}}));
}

TEST(Expression, means_the_natural_logarithm_by_log) { EXPECT_DOUBLE_EQ(evaluate_constant("log(exp(2))", {}), 2); }

TEST(Expression, evaluates_many_points_like_single_ones) {
  const Expression e("x^3 - sin(y)", {});
  const std::vector<Place> places{{0, 1}, {0.5, 2}, {-1, 3}};
  std::vector<double> values(3);
  e.evaluate(places, values);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(values[i], e(places[i].x, places[i].y));
  Expression(7).evaluate(places, values);
  EXPECT_THAT(values, testing::Each(7));
}

TEST(Expression, copies_do_not_share_their_point) {
  const Expression a("x + 10*y", {}), b = a;
  EXPECT_EQ(a(1, 2), 21);
  EXPECT_EQ(b(3, 4), 43);
  EXPECT_EQ(a(1, 2), 21);
}

TEST(Expression, without_x_and_y_is_a_constant) {
  EXPECT_TRUE(Expression().is_constant());
  EXPECT_EQ(Expression()(3, 4), 0);
  EXPECT_EQ(Expression(0.1)(3, 4), 0.1);
  const Expression e("2*R + pi", {{"R", 0.5}});
  EXPECT_TRUE(e.is_constant());
  EXPECT_DOUBLE_EQ(e(1, 2), 1 + std::numbers::pi);
  EXPECT_TRUE(Expression("1e3", {}).is_constant());
}

TEST(Expression, of_constants_may_not_use_x_and_y) {
  EXPECT_DOUBLE_EQ(evaluate_constant("2*sin(R/2)", {{"R", 1}}), 2 * std::sin(0.5));
  EXPECT_THROW(evaluate_constant("2*x", {}), ExpressionError);
}

TEST(WrongExpression, names_the_unknown_name_and_its_place) {
  const auto error = error_of("1 + radius*x", {{"R", 1}});
  EXPECT_THAT(error.what(), HasSubstr("unknown name \"radius\""));
  EXPECT_EQ(error.position, 4u);
  EXPECT_EQ(error_of("x + sine(y)").position, 4u);
}

TEST(WrongExpression, points_into_its_own_text) {
  for (const std::string text :
       {"",       " ",    "x +",  "(x + 1", "x + 1)", "sin(x", "sin()", "atan2(x)", "x y",  "2 x", "* x",
        "x ** 2", "x,,y", "1..2", "x ? 1",  "\"x\"",  "x # y", "sin",   "1e",       "x; y", "x, y"}) {
    SCOPED_TRACE(text);
    const auto error = error_of(text);
    EXPECT_LE(error.position, text.size());
    EXPECT_STRNE(error.what(), "");
  }
}

TEST(WrongExpression, that_is_too_long_or_too_deep_is_refused_and_quoted_shortly) {
  std::string longer = "x", deep = "x";
  while (longer.size() <= longest_expression) longer += "+x";
  for (std::size_t i = 0; i <= deepest_brackets; ++i) deep = "(" + deep + ")";
  EXPECT_THAT(error_of(longer).what(), HasSubstr("at most 4000"));
  EXPECT_THAT(error_of(deep).what(), HasSubstr("brackets in each other"));
  EXPECT_EQ(error_of(deep).position, deepest_brackets);
  EXPECT_LT(std::string(error_of(longer).what()).size(), 150u);
  EXPECT_THROW(evaluate_constant(deep, {}), ExpressionError);
}

TEST(Quotation, is_cut_between_characters) {
  EXPECT_EQ(shortened("short"), "short");
  EXPECT_EQ(shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(shortened("abcdefg", 6), "abc...");
  EXPECT_EQ(shortened("\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9", 4), "\xC3\xA9...");
}

TEST(WrongExpression, that_ends_too_early_is_wrong_at_its_end) { EXPECT_EQ(error_of("x +").position, 3u); }

}  // namespace
}  // namespace plastron::geometry

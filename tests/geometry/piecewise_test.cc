#include <plastron/geometry/pieces.hpp>

#include <gtest/gtest.h>

namespace plastron::geometry {
namespace {

TEST(PiecewiseExpression, has_a_choice_a_comparison_or_a_function_with_a_kink) {
  for (const char* text : {"x < 0.5", "x > 0 ? 1 : 2", "abs(x)", "1 + min(x, y)", "max(x,0)^2", "sign(y)", "x*(y==0)",
                           "sin(abs(x))", "atan2(y, x)", "2*step(x)"})
    EXPECT_TRUE(is_piecewise(Expression(text, {}))) << text;
}

TEST(PiecewiseExpression, is_not_one_that_is_smooth_or_constant_whatever_its_names) {
  for (const char* text :
       {"x^2 + y", "sin(x)*exp(y)", "sqrt(1 - x^2)", "absolute*x", "x_max*y", "min1 + x", "abs(-3)", "2 < 3"})
    EXPECT_FALSE(is_piecewise(Expression(text, {{"absolute", 1}, {"x_max", 2}, {"min1", 3}}))) << text;
  EXPECT_FALSE(is_piecewise(Expression(2.0)));
}

TEST(PiecewiseExpression, stays_so_when_scaled) { EXPECT_TRUE(is_piecewise(Expression("abs(x)", {}).scaled(2))); }

}  // namespace
}  // namespace plastron::geometry

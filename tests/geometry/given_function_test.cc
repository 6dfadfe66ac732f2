// Functions that a program gives under a name, against the same formulas.
#include <plastron/geometry/chart.hpp>
#include <plastron/geometry/given_function.hpp>
#include <plastron/geometry/pieces.hpp>
#include <plastron/geometry/space_function.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace plastron::geometry {
namespace {

/// Gives x^2 y the name "bend" and X Z^3 the name "hill" while a test runs.
class GivenFunctions : public testing::Test {
 protected:
  GivenFunctions() {
    give_function("bend", {.uses_parameters = true, .evaluate = bend});
    give_function("hill", {.uses_space = true, .depends_on = {true, false, true}, .evaluate = hill});
  }
  ~GivenFunctions() override {
    forget_function("bend");
    forget_function("hill");
  }

 private:
  template <std::size_t all, class Row>
  static void fill(std::span<const Place> places, int first, int count, std::span<double> values, const Row& row_at) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::array<double, all> row = row_at(places[i]);
      for (int k = 0; k < count; ++k)
        values[static_cast<std::size_t>(k) * places.size() + i] = row.at(static_cast<std::size_t>(first + k));
    }
  }
  static void bend(std::span<const Place> places, int first, int count, std::span<double> values) {
    fill<6>(places, first, count, values, [](const Place& p) {
      return std::array{p.x * p.x * p.y, 2 * p.x * p.y, p.x * p.x, 2 * p.y, 2 * p.x, 0.0};
    });
  }
  static void hill(std::span<const Place> places, int first, int count, std::span<double> values) {
    fill<10>(places, first, count, values, [](const Place& p) {
      const double z2 = p.Z * p.Z;
      return std::array{p.X * z2 * p.Z, z2 * p.Z, 0.0, 3 * p.X * z2, 0.0, 0.0, 3 * z2, 0.0, 0.0, 6 * p.X * p.Z};
    });
  }
};

TEST_F(GivenFunctions, AreExpressionsUnderTheirNames) {
  const Expression f("bend", {});
  EXPECT_FALSE(f.is_constant());
  EXPECT_TRUE(f.uses_parameters());
  EXPECT_FALSE(f.uses_space());
  EXPECT_FALSE(is_piecewise(f));
  EXPECT_EQ(f.text(), "bend");
  EXPECT_DOUBLE_EQ(f(3, 2), 18);
  EXPECT_DOUBLE_EQ(f.scaled(-0.5)(3, 2), -9);
  const std::vector<Place> places{{.x = 1, .y = 2}, {.x = 3, .y = 4}};
  std::vector<double> values(2);
  f.scaled(2).evaluate(places, values);
  EXPECT_EQ(values, (std::vector<double>{4, 72}));
}

TEST_F(GivenFunctions, OfAChartHaveItsDerivatives) {
  const Chart given({"x", "y", "bend"}, {}), formula({"x", "y", "x^2 * y"}, {});
  const SurfaceJet a = given(0.7, -0.3), b = formula(0.7, -0.3);
  EXPECT_NEAR((a.value - b.value).norm(), 0, 1e-15);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR((a.d[k] - b.d[k]).norm(), 0, 1e-15);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((a.dd[k] - b.dd[k]).norm(), 0, 1e-15);
}

TEST_F(GivenFunctions, OfSpaceHaveGradientAndHessian) {
  const SpaceFunction given("hill", {}), formula("X * Z^3", {});
  const Vector3d X(0.5, -2, 1.5);
  const SpaceJet a = given(X), b = formula(X);
  EXPECT_NEAR(given.value(X), formula.value(X), 1e-15);
  EXPECT_NEAR((a.gradient - b.gradient).norm(), 0, 1e-14);
  EXPECT_NEAR((a.hessian - b.hessian).norm(), 0, 1e-14);
  EXPECT_TRUE(given.depends_on(0));
  EXPECT_FALSE(given.depends_on(1));
}

TEST_F(GivenFunctions, OfTheOtherVariablesAreRefused) {
  EXPECT_THROW(Chart({"x", "y", "hill"}, {}), ExpressionError);
  EXPECT_THROW(SpaceFunction("bend", {}), ExpressionError);
}

TEST_F(GivenFunctions, StayInExpressionsThatHaveThem) {
  const Expression f("bend", {});
  forget_function("bend");
  EXPECT_DOUBLE_EQ(f(3, 2), 18);
  EXPECT_THROW(Expression("bend", {}), ExpressionError);
}

}  // namespace
}  // namespace plastron::geometry

// Measures of solutions: exponents of power laws.
#include <gtest/gtest.h>
#include <research/study/measures.hpp>

#include <cmath>
#include <vector>

namespace plastron::study {
namespace {

TEST(Exponents, of_a_power_law_are_its_power) {
  const std::vector<double> x{1, 0.5, 0.2, 0.1};
  std::vector<double> y;
  for (const double value : x) y.push_back(3 * std::pow(value, 2.5));
  const auto local = local_exponents(x, y);
  EXPECT_TRUE(std::isnan(local[0]));
  for (std::size_t i = 1; i < x.size(); ++i) EXPECT_NEAR(local[i], 2.5, 1e-12);
  EXPECT_NEAR(fitted_exponent(x, y), 2.5, 1e-12);
}

TEST(Exponents, are_fitted_to_the_last_pairs_only) {
  const std::vector<double> x{8, 4, 2, 1}, y{1, 4, 2, 1};
  EXPECT_NEAR(fitted_exponent(x, y), 1, 1e-12);
  EXPECT_LT(fitted_exponent(x, y, 4), 0.9);
}

TEST(Exponents, need_two_positive_pairs) {
  EXPECT_TRUE(std::isnan(fitted_exponent(std::vector<double>{1, 2}, std::vector<double>{0, 1})));
  EXPECT_TRUE(std::isnan(fitted_exponent(std::vector<double>{1}, std::vector<double>{1})));
  EXPECT_TRUE(std::isnan(local_exponents(std::vector<double>{1, 2}, std::vector<double>{0, 1})[1]));
}

}  // namespace
}  // namespace plastron::study

#include <plastron/assembly/element_tables.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace plastron::assembly {
namespace {

TEST(ElementTables, TheWeightsSumToTheUnitSquare) {
  for (int degree = 1; degree <= 8; ++degree) {
    const ElementTables t = element_tables(degree, true);
    EXPECT_NEAR(std::accumulate(t.weights.begin(), t.weights.end(), 0.0), 1, 1e-14);
    EXPECT_NEAR(std::accumulate(t.nodal_weights.begin(), t.nodal_weights.end(), 0.0), 1, 1e-14);
    for (const double w : t.nodal_weights) EXPECT_GT(w, 0);
  }
}

TEST(ElementTables, TyingUsesTheGaussPointsOfM22) {
  for (int k = 1; k <= 8; ++k) {
    const ElementTables t = element_tables(k, true);
    ASSERT_EQ(t.samplings.size(), 3u);
    EXPECT_EQ(t.samplings[0].basis.xi.size(), static_cast<std::size_t>(k * (k + 1)));
    EXPECT_EQ(t.samplings[1].basis.xi.size(), static_cast<std::size_t>(k * (k + 1)));
    EXPECT_EQ(t.samplings[2].basis.xi.size(), static_cast<std::size_t>(k * k));
  }
}

// gamma_11 is tied to degree k - 1 along xi_1 and degree k along xi_2; gamma_12 to k - 1 both ways.
TEST(ElementTables, TiedInterpolationReproducesThePolynomialsItShould) {
  for (const bool tying : {true, false})
    for (int k = 1; k <= 5; ++k) {
      const ElementTables t = element_tables(k, tying);
      const std::vector<Eigen::Vector2d> at{{0.13, 0.71}, {0.97, 0.02}};
      const auto interpolation = tied_interpolation(t, at);
      const int highest[3][2] = {{k - 1, k}, {k, k - 1}, {k - 1, k - 1}};
      for (std::size_t s = 0; s < t.samplings.size(); ++s) {
        const int p = tying ? highest[s][0] : k, q = tying ? highest[s][1] : k;
        const auto f = [&](const Eigen::Vector2d& xi) { return std::pow(xi[0] - 0.3, p) * std::pow(xi[1] + 0.2, q); };
        for (std::size_t i = 0; i < at.size(); ++i) {
          double value = 0;
          for (std::size_t j = 0; j < t.samplings[s].basis.xi.size(); ++j)
            value += interpolation[s](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                     f(t.samplings[s].basis.xi[j]);
          EXPECT_NEAR(value, f(at[i]), 1e-12) << "degree " << k << " set " << s;
        }
      }
    }
}

}  // namespace
}  // namespace plastron::assembly

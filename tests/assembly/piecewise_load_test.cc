// Loads that jump or bend inside of cells: each test divides many cells, a minute with the sanitizers.
#include "assembly/load_samples.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace plastron::assembly {
namespace {

TEST(PiecewiseLoad, SumsToItsIntegralThoughItJumpsInsideOfCells) {
  energy::AreaLoad load;
  load.force[2] = geometry::Expression("x < 1/3 ? 1 : 0", {});
  load.pressure = geometry::Expression("sign(x + y - 0.7)", {});
  load.couple[0] = geometry::Expression("abs(x - 0.3)", {});
  for (const mesh::Shape shape : {test::quadrilateral, test::triangle})
    for (const int degree : {1, 2}) {
      const auto sum = test::total(load_vector(test::plate_operator(degree, shape), {.on_areas = {load}}));
      EXPECT_NEAR(sum[2], 1.0 / 3 + (1 - 0.49), 1e-3);
      EXPECT_NEAR(sum[3], (0.09 + 0.49) / 2, 1e-6);
    }
}

/// The total force of a pressure on the plate of 16 cells.
double pressed(const std::string& pressure, mesh::Shape shape = test::quadrilateral) {
  energy::AreaLoad load;
  load.pressure = geometry::Expression(pressure, {{"a", 0.3141592653}, {"b", 0.6180339887}});
  return test::total(load_vector(test::plate_operator(2, shape), {.on_areas = {load}}))[2];
}

TEST(PiecewiseLoad, OnANarrowPatchSumsToItsIntegral) {
  for (const auto& [pressure, force] : std::vector<std::pair<std::string, double>>{
           {"x > a && x < a + 1e-3 ? 1 : 0", 1e-3},
           {"x > a && x < a + 1e-4 ? 1 : 0", 1e-4},
           {"x > a && x < a + 1e-4 ? x : 0", 1e-4 * (0.3141592653 + 5e-5)},
           {"y > a && y < a + 1e-4 ? 1 : 0", 1e-4},
           {"abs(0.8*(x - a) + 0.6*(y - b)) < 5e-5 && abs(0.8*(y - b) - 0.6*(x - a)) < 0.2 ? 1 : 0", 4e-5},
           {"(x - a)^2 + (y - b)^2 < 1e-3^2 ? 1 : 0", std::numbers::pi * 1e-6},
           {"(x - a)^2 + (y - b)^2 < 1e-4^2 ? 1 : 0", std::numbers::pi * 1e-8},
           {"(x - 0.5)^2 + (y - 0.5)^2 < 1e-4^2 ? 1 : 0", std::numbers::pi * 1e-8},
           {"x < 1/3 ? 1 : 0", 1.0 / 3},
           {"max(x - a, 0)", (1 - 0.3141592653) * (1 - 0.3141592653) / 2}}) {
    EXPECT_NEAR(pressed(pressure) / force, 1, 1e-6) << pressure;
    EXPECT_NEAR(pressed(pressure, test::triangle) / force, 1, 1e-4) << pressure;  // some oblique cells are divided
  }
}

}  // namespace
}  // namespace plastron::assembly

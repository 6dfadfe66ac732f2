#include "assembly/sample_shells.hpp"

#include <plastron/assembly/load_vector.hpp>
#include <plastron/domain/domain.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plastron::assembly {
namespace {

Eigen::Matrix<double, 6, 1> total(const algebra::Vector& f) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < f.owned().size(); ++i) sum[static_cast<Eigen::Index>(i % 6)] += f.owned()[i];
  return sum;
}

ShellOperator cap_on_disk(int degree, int refinements, mesh::Shape shape = test::quadrilateral) {
  const auto m = test::meshed(domain::Disk{.radius = 0.8}, test::cap, degree, refinements, shape);
  return {m.space, m.surface, test::steel_of(geometry::Expression(0.1)), true, false};
}

// The cap of height h of a sphere of radius 2 has the area 2 pi 2 h.
const double cap_area = 2 * std::numbers::pi * 2 * (2 - std::sqrt(4 - 0.64));

TEST(LoadVector, AConstantForceSumsToForceTimesArea) {
  AreaLoad load;
  load.force[2] = geometry::Expression(-3.0);
  load.couple[0] = geometry::Expression(0.5);
  const auto sum = total(load_vector(cap_on_disk(4, 2), {.on_areas = {load}}));
  EXPECT_NEAR(sum[2], -3 * cap_area, 1e-9);
  EXPECT_NEAR(sum[3], 0.5 * cap_area, 1e-9);
  EXPECT_NEAR(sum[0], 0, 1e-12);
}

// Pressure along the normal of a cap has the same total force as pressure on the disk that it spans.
TEST(LoadVector, APressureSumsToPressureTimesProjectedArea) {
  const auto shell = cap_on_disk(4, 2);
  AreaLoad load;
  load.pressure = geometry::Expression(2.0);
  const auto sum = total(load_vector(shell, {.on_areas = {load}}));
  EXPECT_NEAR(sum[2], 2 * std::numbers::pi * 0.64, 1e-9);
}

TEST(LoadVector, AnEdgeLoadSumsToForceTimesLengthOfTheCurveInSpace) {
  EdgeLoad load{.boundary = "rim"};
  load.force[1] = geometry::Expression(7.0);
  load.couple[2] = geometry::Expression("x^2", {});
  const auto sum = total(load_vector(cap_on_disk(4, 2), {.on_edges = {load}}));
  const double length = 2 * std::numbers::pi * 0.8;
  EXPECT_NEAR(sum[1], 7 * length, 1e-9);
  EXPECT_NEAR(sum[5], 0.64 / 2 * length, 1e-6);
}

TEST(LoadVector, TrianglesCarryTheSameTotals) {
  const auto shell = cap_on_disk(2, 4, test::triangle);
  AreaLoad pressure;
  pressure.pressure = geometry::Expression(2.0);
  EdgeLoad rim{.boundary = "rim"};
  rim.force[1] = geometry::Expression(7.0);
  const auto sum = total(load_vector(shell, {.on_areas = {pressure}, .on_edges = {rim}}));
  EXPECT_NEAR(sum[2], 2 * std::numbers::pi * 0.64, 1e-8);
  EXPECT_NEAR(sum[1], 7 * 2 * std::numbers::pi * 0.8, 1e-8);
}

TEST(LoadVector, LoadsAsFunctionsAndAsExpressionsAgree) {
  const auto shell = cap_on_disk(2, 1);
  AreaLoad text, function;
  text.force = {geometry::Expression("x*y", {}), geometry::Expression("sin(x)", {}), geometry::Expression("1 + y", {})};
  function.force_function = [](double x, double y) { return Eigen::Vector3d(x * y, std::sin(x), 1 + y); };
  const auto a = load_vector(shell, {.on_areas = {text}}), b = load_vector(shell, {.on_areas = {function}});
  for (std::size_t i = 0; i < a.owned().size(); ++i) EXPECT_NEAR(a.owned()[i], b.owned()[i], 1e-15);
}

// ---- loads made of pieces ------------------------------------------------------------------------------------------

ShellOperator plate_operator(int degree, mesh::Shape shape, int refinements = 1) {
  const auto m = test::meshed(domain::Rectangle{.to = {1, 1}, .cells = {2, 2}}, test::flat, degree, refinements, shape);
  return {m.space, m.surface, test::steel_of(geometry::Expression(0.1)), true, false};
}

TEST(PiecewiseLoad, SumsToItsIntegralThoughItJumpsInsideOfCells) {
  AreaLoad load;
  load.force[2] = geometry::Expression("x < 1/3 ? 1 : 0", {});
  load.pressure = geometry::Expression("sign(x + y - 0.7)", {});
  load.couple[0] = geometry::Expression("abs(x - 0.3)", {});
  for (const mesh::Shape shape : {test::quadrilateral, test::triangle})
    for (const int degree : {1, 2}) {
      const auto sum = total(load_vector(plate_operator(degree, shape), {.on_areas = {load}}));
      EXPECT_NEAR(sum[2], 1.0 / 3 + (1 - 0.49), 1e-3);
      EXPECT_NEAR(sum[3], (0.09 + 0.49) / 2, 1e-6);
    }
}

TEST(PiecewiseLoad, OnAnEdgeSumsToItsIntegral) {
  EdgeLoad load{.boundary = "bottom"};
  load.force[2] = geometry::Expression("x < 1/3 ? 1 : 0", {});
  load.couple[1] = geometry::Expression("max(x - 0.3, 0)", {});
  for (const mesh::Shape shape : {test::quadrilateral, test::triangle}) {
    const auto sum = total(load_vector(plate_operator(2, shape), {.on_edges = {load}}));
    EXPECT_NEAR(sum[2], 1.0 / 3, 2e-6);
    EXPECT_NEAR(sum[4], 0.49 / 2, 1e-6);
  }
}

TEST(PiecewiseLoad, ThatIsSmoothAfterAllIsTheSmoothLoad) {
  const auto shell = cap_on_disk(3, 3);
  AreaLoad piecewise, smooth;
  piecewise.pressure = geometry::Expression("x < 5 ? 1 + x^2 : 0", {});
  smooth.pressure = geometry::Expression("1 + x^2", {});
  EdgeLoad rim{.boundary = "rim"}, smooth_rim{.boundary = "rim"};
  rim.force[0] = geometry::Expression("max(x^2, -1)", {});
  smooth_rim.force[0] = geometry::Expression("x^2", {});
  const auto a = load_vector(shell, {.on_areas = {piecewise}, .on_edges = {rim}}),
             b = load_vector(shell, {.on_areas = {smooth}, .on_edges = {smooth_rim}});
  for (std::size_t i = 0; i < a.owned().size(); ++i) EXPECT_NEAR(a.owned()[i], b.owned()[i], 1e-8);
}

/// The total force of a pressure on the plate of 16 cells.
double pressed(const std::string& pressure, mesh::Shape shape = test::quadrilateral) {
  AreaLoad load;
  load.pressure = geometry::Expression(pressure, {{"a", 0.3141592653}, {"b", 0.6180339887}});
  return total(load_vector(plate_operator(2, shape), {.on_areas = {load}}))[2];
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

TEST(PiecewiseLoad, OnAShortPartOfAnEdgeSumsToItsIntegral) {
  for (const double length : {1e-3, 1e-4, 1e-5})
    for (const double start : {0.1234567, 0.25, 0.6180339887, 0.99}) {
      EdgeLoad load{.boundary = "bottom"};
      load.force[1] = geometry::Expression("x > a && x < a + w ? 1 : 0", {{"a", start}, {"w", length}});
      EXPECT_NEAR(total(load_vector(plate_operator(2, test::quadrilateral), {.on_edges = {load}}))[1] / length, 1, 1e-6)
          << start;
    }
}

TEST(PiecewiseLoad, IsIntegratedAlikeWithCovariantInterpolation) {
  const auto m = test::meshed(domain::Rectangle{.to = {1, 1}, .cells = {2, 2}}, test::flat, 2, 1);
  const ShellOperator covariant(m.space, m.surface, test::steel_of(geometry::Expression(0.1)), true, true);
  AreaLoad load;
  load.force[2] = geometry::Expression("x < 1/3 ? 1 : 0", {});
  const auto a = load_vector(covariant, {.on_areas = {load}}),
             b = load_vector(plate_operator(2, test::quadrilateral), {.on_areas = {load}});
  for (std::size_t i = 0; i < a.owned().size(); ++i) EXPECT_NEAR(a.owned()[i], b.owned()[i], 1e-14);
}

TEST(LoadVector, OfALoadThatIsNotFiniteSaysWhere) {
  AreaLoad area;
  area.pressure = geometry::Expression("log(x - 0.6)", {});
  EdgeLoad edge{.boundary = "left"};
  edge.couple[0] = geometry::Expression("sqrt(y - 0.9)", {});
  for (const Loads& loads : {Loads{.on_areas = {area}}, Loads{.on_edges = {edge}}}) {
    try {
      load_vector(plate_operator(2, test::quadrilateral), loads);
      FAIL() << "accepted";
    } catch (const LoadError& error) {
      EXPECT_NE(std::string(error.what()).find("not a number near x = 0"), std::string::npos) << error.what();
    }
  }
}

TEST(Loads, NameTheirExpressionsAndPlaces) {
  const Loads loads{.on_areas = {{.regions = {"a", "b"}}}, .on_edges = {{.boundary = "rim"}}};
  std::vector<std::string> names;
  loads.for_each_expression([&](const geometry::Expression&, const std::string& name, const LoadPlace& place) {
    names.push_back(name);
    EXPECT_EQ(place.boundary, names.size() > 7 ? "rim" : "");
    EXPECT_EQ(place.regions.size(), names.size() > 7 ? 0u : 2u);
  });
  ASSERT_EQ(names.size(), 13u);
  EXPECT_EQ(names[2], "the z component of a load's force");
  EXPECT_EQ(names[3], "a load's pressure");
  EXPECT_EQ(names[7], "the x component of a load's force");
  EXPECT_EQ(names[12], "the z component of a load's couple");
  EXPECT_EQ(loads.region_names(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(loads.boundary_names(), std::vector<std::string>{"rim"});
}

}  // namespace
}  // namespace plastron::assembly

#include "assembly/load_samples.hpp"

#include <plastron/assembly/nodal_geometry.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace plastron::assembly {
namespace {

energy::ShellOperator cap_operator(int degree, int refinements, mesh::Shape shape = test::quadrilateral) {
  const auto m = test::meshed(domain::Disk{.radius = 0.8}, test::cap, degree, refinements, shape);
  return {m.space, m.surface, test::steel_of(geometry::Expression(0.1)), true, false};
}

// The cap of height h of a sphere of radius 2 has the area 2 pi 2 h.
const double cap_area = 2 * std::numbers::pi * 2 * (2 - std::sqrt(4 - 0.64));

TEST(LoadVector, AConstantForceSumsToForceTimesArea) {
  energy::AreaLoad load;
  load.force[2] = geometry::Expression(-3.0);
  load.couple[0] = geometry::Expression(0.5);
  const auto sum = test::total(load_vector(cap_operator(4, 2), {.on_areas = {load}}));
  EXPECT_NEAR(sum[2], -3 * cap_area, 1e-9);
  EXPECT_NEAR(sum[3], 0.5 * cap_area, 1e-9);
  EXPECT_NEAR(sum[0], 0, 1e-12);
}

// Pressure along the normal of a cap has the same total force as pressure on the disk that it spans.
TEST(LoadVector, APressureSumsToPressureTimesProjectedArea) {
  const auto shell = cap_operator(4, 2);
  energy::AreaLoad load;
  load.pressure = geometry::Expression(2.0);
  const auto sum = test::total(load_vector(shell, {.on_areas = {load}}));
  EXPECT_NEAR(sum[2], 2 * std::numbers::pi * 0.64, 1e-9);
}

TEST(LoadVector, AnEdgeLoadSumsToForceTimesLengthOfTheCurveInSpace) {
  energy::EdgeLoad load{.boundary = "rim"};
  load.force[1] = geometry::Expression(7.0);
  load.couple[2] = geometry::Expression("x^2", {});
  const auto sum = test::total(load_vector(cap_operator(4, 2), {.on_edges = {load}}));
  const double length = 2 * std::numbers::pi * 0.8;
  EXPECT_NEAR(sum[1], 7 * length, 1e-9);
  EXPECT_NEAR(sum[5], 0.64 / 2 * length, 1e-6);
}

TEST(LoadVector, TrianglesCarryTheSameTotals) {
  const auto shell = cap_operator(2, 4, test::triangle);
  energy::AreaLoad pressure;
  pressure.pressure = geometry::Expression(2.0);
  energy::EdgeLoad rim{.boundary = "rim"};
  rim.force[1] = geometry::Expression(7.0);
  const auto sum = test::total(load_vector(shell, {.on_areas = {pressure}, .on_edges = {rim}}));
  EXPECT_NEAR(sum[2], 2 * std::numbers::pi * 0.64, 1e-8);
  EXPECT_NEAR(sum[1], 7 * 2 * std::numbers::pi * 0.8, 1e-8);
}

/// On any mesh, however coarse, and of the density force / area of this mesh.
TEST(LoadVector, ATotalForceIsTheSumOfAnEvenLoad) {
  const Eigen::Vector3d force(3, -5, 7);
  for (const auto& [shape, degree] : {std::pair(test::quadrilateral, 1), {test::quadrilateral, 4}, {test::triangle, 2}})
    for (const int refinements : {0, 2}) {
      const auto shell = cap_operator(degree, refinements, shape);
      for (const std::vector<std::string>& boundaries : {std::vector<std::string>{}, {"rim"}}) {
        const energy::TotalForce total{.force = force, .boundaries = boundaries};
        const algebra::Vector found = load_vector(shell, {.totals = {total}});
        const auto sum = test::total(found);
        EXPECT_LT((sum.head<3>() - force).norm(), 1e-13 * force.norm());
        const algebra::Vector even = load_vector(
            shell, total.spread({geometry::Expression(0), geometry::Expression(0), geometry::Expression(1)}));
        const double measure = test::total(even)[2];
        for (std::size_t i = 0; i < found.owned().size(); i += 6)
          EXPECT_NEAR(found.owned()[i + 2], force[2] / measure * even.owned()[i + 2], 1e-14);
        energy::Loads twice{.totals = {total}};
        twice.scale(2);
        EXPECT_LT((test::total(load_vector(shell, twice)).head<3>() - 2 * force).norm(), 1e-12);
      }
    }
}

/// Spots that are smaller than a cell, larger, and cut by the rim. The moment is about the centroid of the even force.
TEST(LoadVector, ForceAndMomentAtAPointAreTheGivenOnes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  const auto vector = [&] { return Eigen::Vector3d(part(random), part(random), part(random)); };
  const auto check = [&](const energy::ShellOperator& shell, const Eigen::Vector3d& point, double radius) {
    energy::TotalForce load{.force = vector()};
    load.spot = {.point = point, .radius = radius};
    const auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
    const auto resultants = [&](const algebra::Vector& f) {
      Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
      for (std::size_t n = 0; n < f.owned().size() / 6; ++n) {
        const Eigen::Vector3d own(f.owned()[6 * n], f.owned()[6 * n + 1], f.owned()[6 * n + 2]);
        force += own;
        moment += points[n].phi.cross(own);
      }
      return std::pair(force, moment);
    };
    const auto even = resultants(load_vector(shell, {.totals = {load}}));
    EXPECT_LT((even.first - load.force).norm(), 1e-12) << radius;
    // The force acts within the spot.
    const Eigen::Vector3d arm = point.cross(load.force) - even.second;
    EXPECT_LT(arm.norm(), 1.1 * radius * load.force.norm() + 1e-12) << radius;
    load.moment = vector();
    const auto both = resultants(load_vector(shell, {.totals = {load}}));
    EXPECT_LT((both.first - load.force).norm(), 1e-9) << radius;
    EXPECT_LT((both.second - even.second - load.moment).norm(), 1e-9) << radius;
  };
  for (const mesh::Shape shape : {test::quadrilateral, test::triangle})
    for (const double radius : {1e-4, 0.03, 0.4}) {
      check(test::plate_operator(2, shape), {0.37, 0.61, 0.3}, radius);
      check(test::plate_operator(2, shape), {0.2, 1e-5, 0.3}, radius);
      check(cap_operator(2, 1, shape), {0.3, 0.4, 2 - std::sqrt(3.75)}, std::max(radius, 1e-2));
    }
}

TEST(LoadVector, LoadsActWhereTheirConditionHolds) {
  const auto shell = cap_operator(2, 1);
  energy::AreaLoad conditioned, composed;
  conditioned.pressure = geometry::Expression("1 + x", {});
  conditioned.couple[1] = geometry::Expression(3.0);
  conditioned.where = geometry::Expression("X > 0.1 && Y < 0.2", {});
  composed.pressure = geometry::Expression("X > 0.1 && Y < 0.2 ? 1 + x : 0", {});
  composed.couple[1] = geometry::Expression("X > 0.1 && Y < 0.2 ? 3 : 0", {});
  const auto a = load_vector(shell, {.on_areas = {conditioned}}), b = load_vector(shell, {.on_areas = {composed}});
  for (std::size_t i = 0; i < a.owned().size(); ++i) EXPECT_NEAR(a.owned()[i], b.owned()[i], 1e-13);
}

TEST(LoadVector, APlaceOffTheShellIsAnError) {
  const auto shell = cap_operator(2, 1);
  energy::TotalForce load{.force = {0, 0, 1}, .spot = energy::Spot{.point = {0, 0, 5}, .radius = 0.1}};
  EXPECT_THROW(load_vector(shell, {.totals = {load}}), energy::LoadError);
  load = {.force = {0, 0, 1}, .where = geometry::Expression("X > 100", {})};
  EXPECT_THROW(load_vector(shell, {.totals = {load}}), energy::LoadError);
  load = {.moment = {1, 0, 0}, .boundaries = {"bottom"}};  // a straight line along x
  EXPECT_THROW(load_vector(test::plate_operator(2, test::quadrilateral), {.totals = {load}}), energy::LoadError);
}

TEST(LoadVector, LoadsAsFunctionsAndAsExpressionsAgree) {
  const auto shell = cap_operator(2, 1);
  energy::AreaLoad text, function;
  text.force = {geometry::Expression("x*y", {}), geometry::Expression("sin(x)", {}), geometry::Expression("1 + y", {})};
  function.force_function = [](double x, double y) { return Eigen::Vector3d(x * y, std::sin(x), 1 + y); };
  const auto a = load_vector(shell, {.on_areas = {text}}), b = load_vector(shell, {.on_areas = {function}});
  for (std::size_t i = 0; i < a.owned().size(); ++i) EXPECT_NEAR(a.owned()[i], b.owned()[i], 1e-15);
}

// ---- loads made of pieces; more in piecewise_load_test.cc --------------------------------------------------------

TEST(PiecewiseLoad, OnAnEdgeSumsToItsIntegral) {
  energy::EdgeLoad load{.boundary = "bottom"};
  load.force[2] = geometry::Expression("x < 1/3 ? 1 : 0", {});
  load.couple[1] = geometry::Expression("max(x - 0.3, 0)", {});
  for (const mesh::Shape shape : {test::quadrilateral, test::triangle}) {
    const auto sum = test::total(load_vector(test::plate_operator(2, shape), {.on_edges = {load}}));
    EXPECT_NEAR(sum[2], 1.0 / 3, 2e-6);
    EXPECT_NEAR(sum[4], 0.49 / 2, 1e-6);
  }
}

TEST(PiecewiseLoad, ThatIsSmoothAfterAllIsTheSmoothLoad) {
  const auto shell = cap_operator(3, 3);
  energy::AreaLoad piecewise, smooth;
  piecewise.pressure = geometry::Expression("x < 5 ? 1 + x^2 : 0", {});
  smooth.pressure = geometry::Expression("1 + x^2", {});
  energy::EdgeLoad rim{.boundary = "rim"}, smooth_rim{.boundary = "rim"};
  rim.force[0] = geometry::Expression("max(x^2, -1)", {});
  smooth_rim.force[0] = geometry::Expression("x^2", {});
  const auto a = load_vector(shell, {.on_areas = {piecewise}, .on_edges = {rim}}),
             b = load_vector(shell, {.on_areas = {smooth}, .on_edges = {smooth_rim}});
  for (std::size_t i = 0; i < a.owned().size(); ++i) EXPECT_NEAR(a.owned()[i], b.owned()[i], 1e-8);
}

TEST(PiecewiseLoad, OnAShortPartOfAnEdgeSumsToItsIntegral) {
  for (const double length : {1e-3, 1e-4, 1e-5})
    for (const double start : {0.1234567, 0.25, 0.6180339887, 0.99}) {
      energy::EdgeLoad load{.boundary = "bottom"};
      load.force[1] = geometry::Expression("x > a && x < a + w ? 1 : 0", {{"a", start}, {"w", length}});
      EXPECT_NEAR(
          test::total(load_vector(test::plate_operator(2, test::quadrilateral), {.on_edges = {load}}))[1] / length, 1,
          1e-6)
          << start;
    }
}

TEST(PiecewiseLoad, IsIntegratedAlikeWithCovariantInterpolation) {
  const auto m = test::meshed(domain::Rectangle{.to = {1, 1}, .cells = {2, 2}}, test::flat, 2, 1);
  const energy::ShellOperator covariant(m.space, m.surface, test::steel_of(geometry::Expression(0.1)), true, true);
  energy::AreaLoad load;
  load.force[2] = geometry::Expression("x < 1/3 ? 1 : 0", {});
  const auto a = load_vector(covariant, {.on_areas = {load}}),
             b = load_vector(test::plate_operator(2, test::quadrilateral), {.on_areas = {load}});
  for (std::size_t i = 0; i < a.owned().size(); ++i) EXPECT_NEAR(a.owned()[i], b.owned()[i], 1e-14);
}

TEST(LoadVector, OfALoadThatIsNotFiniteSaysWhere) {
  energy::AreaLoad area;
  area.pressure = geometry::Expression("log(x - 0.6)", {});
  energy::EdgeLoad edge{.boundary = "left"};
  edge.couple[0] = geometry::Expression("sqrt(y - 0.9)", {});
  for (const energy::Loads& loads : {energy::Loads{.on_areas = {area}}, energy::Loads{.on_edges = {edge}}}) {
    try {
      load_vector(test::plate_operator(2, test::quadrilateral), loads);
      FAIL() << "accepted";
    } catch (const energy::LoadError& error) {
      EXPECT_NE(std::string(error.what()).find("not a number near x = 0"), std::string::npos) << error.what();
    }
  }
}

TEST(Loads, NameTheirExpressionsAndPlaces) {
  const energy::Loads loads{.on_areas = {{.regions = {"a", "b"}}}, .on_edges = {{.boundary = "rim"}}};
  std::vector<std::string> names;
  loads.for_each_expression([&](const geometry::Expression&, const std::string& name, const energy::LoadPlace& place) {
    names.push_back(name);
    const bool is_on_edge = (names.size() > 7 && names.size() < 14) || names.size() == 15;
    EXPECT_EQ(place.boundary, is_on_edge ? "rim" : "");
    EXPECT_EQ(place.regions.size(), is_on_edge ? 0u : 2u);
  });
  ASSERT_EQ(names.size(), 15u);
  EXPECT_EQ(names[2], "the z component of a load's force");
  EXPECT_EQ(names[3], "a load's pressure");
  EXPECT_EQ(names[7], "the x component of a load's force");
  EXPECT_EQ(names[12], "the z component of a load's couple");
  EXPECT_EQ(names[14], "the place of a load");
  EXPECT_EQ(loads.region_names(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(loads.boundary_names(), std::vector<std::string>{"rim"});
}

}  // namespace
}  // namespace plastron::assembly

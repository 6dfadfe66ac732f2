// Shells between two obstacles, against plane references with 16 digits (an exact solution between the edges of contact).
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;
using Eigen::Vector3d;

constexpr double width = 0.125, thick = 0.1;

/// A strip of length 1 in plane strain, clamped at both ends, between the floor z = 0 and a ceiling. The load acts along z.
problem::Problem strip(const std::string& height, const std::string& load, double ceiling) {
  problem::Problem p;
  p.domain = domain::Rectangle{.to = {1, width}, .cells = {8, 1}};
  p.charts = {{"", Chart({"x", "y", height}, {})}};
  p.shell.sections.common.thickness = Expression(thick);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.supports = {clamped("left"), clamped("right")};
  for (const char* side : {"bottom", "top"})
    p.shell.supports.push_back(
        {.boundary = side,
         .components = {fixed(Unknown::displacement, Direction::y), fixed(Unknown::rotation, Direction::y)}});
  p.shell.loads.on_areas = {energy::AreaLoad{.force = {Expression(0.0), Expression(0.0), Expression(load, {})}}};
  p.shell.obstacles.all = {{.name = "floor"},
                           {.name = "ceiling",
                            .shape = obstacle::HalfSpace{.point = {0, 0, ceiling}, .normal = {0, 0, -1}},
                            .face = obstacle::Face::upper}};
  p.discretisation = {.degree = 3, .refinements = 3};
  return p;
}

struct Reference {
  const char* name;
  problem::Problem problem;
  double energy, floor, ceiling;  ///< per unit width
};

std::ostream& operator<<(std::ostream& out, const Reference& r) { return out << r.name; }

class Between : public testing::TestWithParam<Reference> {};

TEST_P(Between, FloorAndCeilingCarryWhatTheReferenceSays) {
  const Reference& reference = GetParam();
  const Result result = solve(reference.problem, MPI_COMM_SELF);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_NEAR(result.summary.energy.total(), width * reference.energy, 1e-3 * width * reference.energy);
  ASSERT_EQ(result.summary.obstacles.size(), 2U);
  const auto& [floor, ceiling] = std::tie(result.summary.obstacles[0], result.summary.obstacles[1]);
  EXPECT_EQ(ceiling.name, "ceiling");
  EXPECT_NEAR(floor.reaction.force[2], width * reference.floor, 2e-4 * width * reference.floor);
  EXPECT_NEAR(ceiling.reaction.force[2], width * reference.ceiling, 2e-4 * width * std::abs(reference.ceiling));
  EXPECT_GT(floor.nodes, 100);
  EXPECT_EQ(floor.nodes + ceiling.nodes, result.summary.touching_nodes);
  EXPECT_NEAR(floor.area + ceiling.area, result.summary.contact_area, 1e-14);
  for (const Level& level : result.levels) EXPECT_LE(level.iterations, 8);
}

INSTANTIATE_TEST_SUITE_P(
    FloorAndCeiling, Between,
    testing::Values(Reference{"flat", strip("0.06", "-0.05*sin(2*pi*x)", 0.115), 1.58972104252893952e-05,
                              1.25420100815093190e-02, -1.32295673989753521e-02},
                    Reference{"wavy", strip("0.09 + 0.03*sin(2*pi*x)", "0.05*sin(2*pi*x)", 0.175),
                              5.59901021090944603e-05, 1.12991423924100349e-02, -1.16468957853493538e-02}),
    [](const auto& reference) { return std::string(reference.param.name); });

TEST(Between, PlatesThatAreMirrorImagesTheReactionsAreToo) {
  problem::Problem p = strip("0.06", "0.05*sin(2*pi*x)", 0.12);
  const Result result = solve(p, MPI_COMM_SELF);
  ASSERT_EQ(result.status, contact::Status::solved);
  const auto& obstacles = result.summary.obstacles;
  EXPECT_GT(obstacles[0].reaction.force[2], 1e-3 * width);
  EXPECT_NEAR(obstacles[0].reaction.force[2], -obstacles[1].reaction.force[2], 1e-10);
  EXPECT_EQ(obstacles[0].nodes, obstacles[1].nodes);
}

/// A plate on rollers along y; its load presses it on them.
problem::Problem plate_on_rollers(const std::vector<double>& places, double radius) {
  problem::Problem p;
  p.domain = domain::Rectangle{.from = {-1, 0}, .to = {1, 0.25}, .cells = {8, 1}};
  p.charts = {{"", Chart({"x", "y", "0"}, {})}};
  p.shell.sections.common.thickness = Expression(thick);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.supports = {held("left", {Direction::x, Direction::y}), in_plane("bottom"), in_plane("top")};
  p.shell.loads.on_areas = {force(0, 0, -1e-5)};
  for (const double x : places)
    p.shell.obstacles.all.push_back(
        {.name = "roller at " + std::to_string(x),
         .shape = obstacle::Cylinder{.point = {x, 0, -radius - thick / 2}, .axis = {0, 1, 0}, .radius = radius}});
  p.discretisation = {.degree = 2, .refinements = 2};
  return p;
}

TEST(ThreeRollers, WhoseNormalsLieInOnePlaneCarryAPlateAtThreePlaces) {
  const problem::Problem p = plate_on_rollers({-0.75, 0, 0.75}, 0.05);
  const Result r = solve(p, MPI_COMM_SELF);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  const auto force = [&](std::size_t k) { return r.summary.obstacles.at(k).reaction.force[2]; };
  EXPECT_NEAR(force(0) + force(1) + force(2), 1e-5 * 2 * 0.25, 1e-11);
  EXPECT_NEAR(force(0), force(2), 1e-6 * force(0));
  EXPECT_GT(force(1), 0);
  EXPECT_GE(r.certificate.min_gap_nodes, -1e-12);
}

TEST(AFarRoller, ChangesNothing) {
  const Result two = solve(plate_on_rollers({-0.75, 0.75}, 0.05), MPI_COMM_SELF);
  problem::Problem p = plate_on_rollers({-0.75, 0.75}, 0.05);
  p.shell.obstacles.all.push_back(
      {.name = "far", .shape = obstacle::Cylinder{.point = {0.1, 0, -3}, .axis = {0, 1, 0}, .radius = 0.5}});
  const Result three = solve(p, MPI_COMM_SELF);
  ASSERT_EQ(two.status, contact::Status::solved);
  ASSERT_EQ(three.status, contact::Status::solved);
  EXPECT_NEAR(three.summary.energy.total() / two.summary.energy.total(), 1, 1e-9);
  EXPECT_EQ(three.summary.obstacles.at(2).nodes, 0);
}

/// A strip of length L with a small wave, pushed at its right end below its buckling load.
problem::Problem pushed_strip(element::Rotations rotations, double L, bool is_upright) {
  const auto in_units = [&](double x) { return fmt::format("{:.17g}", x * L); };
  const std::string wave = in_units(5e-5) + "*(1 - cos(2*pi*x/" + in_units(1) + "))";
  problem::Problem p;
  p.domain = domain::Rectangle{.to = {L, 0.05 * L}, .cells = {6, 1}};
  p.charts = {{"", Chart({is_upright ? "-" + wave : "x", "y", is_upright ? "x" : wave}, {})}};
  p.shell.sections.common.thickness = Expression(0.005 * L);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1e9, 0.3, 1);
  p.shell.rotations = rotations;
  p.shell.supports = {clamped("left"), clamped("right")};
  p.shell.supports.back().components[is_upright ? 2 : 0].value = Expression(-2.8e-5 * L);
  p.discretisation = {.degree = 2, .refinements = 0};
  return p;
}

using Shapes = std::vector<obstacle::Shape>;

/// Bodies around the middle of the strip at about these distances from it, on both sides and at its end.
std::vector<Shapes> bodies_around(double L, double distance, bool is_upright) {
  const Vector3d across = is_upright ? Vector3d(-1, 0, 0) : Vector3d(0, 0, 1),
                 along = is_upright ? Vector3d(0, 0, 1) : Vector3d(1, 0, 0), middle = L / 2 * along,
                 d = distance * L * across;
  const obstacle::HalfSpace floor{middle - d, across}, ceiling{middle + d, -across},
      inclined{middle + 2 * d, (0.05 * along - across).normalized()}, wall{(1 + distance) * L * along, -along};
  const obstacle::Ball below{middle - d - 3 * L * across, 3 * L}, above{middle + d + 2 * L * across, 2 * L};
  const obstacle::Cylinder tube{.point = middle, .axis = along, .radius = distance * L, .inside = true};
  return {{floor, ceiling},     {inclined, floor},      {ceiling, below},
          {below, above, wall}, {floor, wall, ceiling}, {tube, floor}};
}

// The gaps of both faces change oppositely, but for the slope of the shell: their difference is a rotation divided by it.
TEST(ObstaclesOnBothSides, ThatAreNotTouchedChangeNothing) {
  for (const auto rotations : {element::Rotations::small, element::Rotations::finite})
    for (const double L : {1.0, 1e-6, 1e6})
      for (const bool is_upright : {false, true}) {
        problem::Problem p = pushed_strip(rotations, L, is_upright);
        const Result alone = solve(p, MPI_COMM_SELF);
        ASSERT_EQ(alone.status, contact::Status::solved) << alone.missed_limits;
        for (const double distance : {0.3, 100.0})
          for (const Shapes& shapes : bodies_around(L, distance, is_upright)) {
            p.shell.obstacles.all.clear();
            for (const obstacle::Shape& shape : shapes)
              p.shell.obstacles.all.push_back({.name = std::to_string(p.shell.obstacles.all.size()), .shape = shape});
            const Result among = solve(p, MPI_COMM_SELF);
            ASSERT_EQ(among.status, contact::Status::solved) << L << " " << distance << among.missed_limits;
            EXPECT_NEAR(among.summary.energy.total() / alone.summary.energy.total(), 1, 1e-8);
            EXPECT_EQ(among.summary.touching_nodes, 0);
            EXPECT_LE(among.levels.back().iterations, alone.levels.back().iterations + 2);
          }
      }
}

TEST(ATubeBetweenPlates, GetsShorterAsARingDoes) {
  const double pi = 3.141592653589793, length = 0.25, thickness = 0.02, force = 0.01;
  problem::Problem p;
  p.domain = domain::Rectangle{.from = {-pi, 0}, .to = {pi, length}, .cells = {16, 1}};
  p.joins = {{{"left", "right"}}};
  p.charts = {{"", Chart({"sin(x)", "y", "1.01 - cos(x)"}, {})}};
  p.shell.sections.common.thickness = Expression(thickness);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1e6, 0.3, 1);
  p.shell.supports = {in_plane("bottom"), in_plane("top")};
  for (const double x : {0.0, -pi})
    p.shell.supports.push_back(
        {.components = {fixed(Unknown::displacement, Direction::x)}, .point = Eigen::Vector2d(x, length / 2)});
  p.shell.obstacles.all = {{.name = "floor"},
                           {.name = "plate",
                            .shape = obstacle::HalfSpace{.point = {0, 0, 2.02}, .normal = {0, 0, -1}},
                            .force = {0, 0, -force}}};
  p.discretisation = {.degree = 4, .refinements = 1};
  const Result r = solve(p, MPI_COMM_SELF);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  const double way = (pi / 4 - 2 / pi) * force / length * 12 * (1 - 0.09) / (1e6 * std::pow(thickness, 3));
  EXPECT_NEAR(-r.summary.obstacles.at(1).translation[2] / way, 1, 2e-3);  // shear and stretching: (e/R)^2
  EXPECT_NEAR(r.summary.obstacles.at(0).reaction.force[2], force, 1e-8 * force);
  EXPECT_NEAR(r.summary.obstacles.at(1).reaction.force[2], -force, 1e-8 * force);
  EXPECT_NEAR(r.summary.energy.total(), -force * r.summary.obstacles.at(1).translation[2] / 2, 1e-6 * force * way);
  for (const std::string& warning : r.warnings)  // the tube touches both plates along a line
    EXPECT_NE(warning.find("along lines"), std::string::npos) << warning;
}

}  // namespace
}  // namespace plastron::computation

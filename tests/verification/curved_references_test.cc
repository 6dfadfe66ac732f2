// Shells against curved obstacles with known answers: energy, reaction, deflection, contact boundary. With the gap of the undeformed shell
// (M16) and with the distance of the deformed shell.
#include "verification/reference_problems.hpp"

#include <plastron/computation/solve.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace plastron::verification {
namespace {

using geometry::Constants;
using geometry::Expression;
using obstacle::Face;

double scalar(const std::string& problem, const std::string& name) {
  static const auto file = [] {
    std::ifstream stream(PLASTRON_REFERENCE_DIR "/curved.json");
    return nlohmann::json::parse(stream);
  }();
  return file.at(problem).at("scalars").at(name).get<double>();
}

assembly::Support clamped(const std::string& boundary) {
  assembly::Support support{.boundary = boundary, .components = {}};
  for (const auto unknown : {assembly::Unknown::displacement, assembly::Unknown::rotation})
    for (const auto direction : {assembly::Direction::x, assembly::Direction::y, assembly::Direction::z})
      support.components.push_back({unknown, direction, Expression(0.0)});
  return support;
}

std::shared_ptr<const geometry::SpaceFunction> function(const std::string& text) {
  return std::make_shared<const geometry::SpaceFunction>(text, Constants{});
}

struct Indented {
  std::string name;
  double thickness, radius, depth;  ///< of the shell, of the ball, of its lowest point under the shell's highest
  bool dome;
  bool once;  ///< linearised at the undeformed shell
};

problem::Problem problem_of(const Indented& p) {
  problem::Problem problem;
  const Constants constants{{"e", p.thickness}};
  problem.domain = domain::Disk{.radius = p.dome ? std::sin(0.5) : 1.0};
  problem.charts.emplace("", p.dome ? geometry::Chart({"x", "y", "-1 - e/2 + sqrt(1 - x^2 - y^2)"}, constants)
                                    : geometry::Chart({"x", "y", "-e/2"}, constants));
  problem.shell.sections.common.thickness = Expression(p.thickness);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  problem.shell.supports = {clamped("rim")};
  problem.shell.obstacles.all = {{.name = "ball",
                                  .shape = obstacle::Ball{.centre = {0, 0, p.radius - p.depth}, .radius = p.radius},
                                  .face = Face::upper}};
  problem.shell.obstacles.are_linear = p.once;
  problem.probes = {{.name = "apex", .at = {0, 0}}};
  problem.discretisation.degree = 4;
  problem.discretisation.refinements = 3;
  return problem;
}

class IndentedShell : public testing::TestWithParam<Indented> {};
INSTANTIATE_TEST_SUITE_P(All, IndentedShell,
                         testing::Values(Indented{"C1plate_e0.1_d0.1", 0.1, 2, 0.1, false, true},
                                         Indented{"C1plate_e0.05_d0.2", 0.05, 2, 0.2, false, true},
                                         Indented{"C1dome_e0.05_d0.1", 0.05, 0.5, 0.1, true, true},
                                         Indented{"C3dome_e0.05_d0.1", 0.05, 0.5, 0.1, true, false}),
                         [](const auto& p) {
                           std::string name = p.param.name;
                           std::ranges::replace_if(
                               name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
                           return name;
                         });

TEST_P(IndentedShell, HasTheEnergyTheReactionAndTheDeflectionOfTheReference) {
  const Indented& p = GetParam();
  const computation::Result r = computation::solve(problem_of(p), MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved);
  EXPECT_LE(r.levels.back().unknowns, 60'000);
  EXPECT_NEAR(r.summary.energy.total() / scalar(p.name, "E_total"), 1, 1e-3);
  EXPECT_NEAR(r.summary.reaction.force[2] / scalar(p.name, "reaction_z_0"), 1, 1e-3);
  EXPECT_LT(r.summary.reaction.force.head<2>().norm(), 1e-6 * r.summary.reaction.force.norm());
  EXPECT_NEAR(r.probes.at(0).values.u[2] / scalar(p.name, "uz_axis"), 1, 1e-3);
  for (const computation::Level& level : r.levels) {
    EXPECT_EQ(level.linearisations > 1, !p.once);
    EXPECT_LT(level.gap_error, p.once ? p.depth : 1e-8 * p.depth);
  }
  EXPECT_LT(r.certificate.force_balance, 1e-8);
}

// ---- prescribed force --------------------------------------------------------------------------------------------------

struct Pressed {
  std::string name;
  double thickness, radius, force;
  bool dome, once;
};

class PressedShell : public testing::TestWithParam<Pressed> {};
INSTANTIATE_TEST_SUITE_P(All, PressedShell,
                         testing::Values(Pressed{"C2plate_e0.1_F5e-4_aff", 0.1, 2, 5e-4, false, true},
                                         Pressed{"C2dome_e0.05_F6e-4_true", 0.05, 0.5, 6e-4, true, false}),
                         [](const auto& p) { return p.param.dome ? "Dome" : "Plate"; });

TEST_P(PressedShell, CarriesTheForceAtTheDepthOfTheReference) {
  const Pressed& p = GetParam();
  auto problem = problem_of({p.name, p.thickness, p.radius, 0, p.dome, p.once});
  problem.shell.obstacles.all[0].force = {0, 0, -p.force};
  const computation::Result r = computation::solve(problem, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  EXPECT_LE(r.levels.back().unknowns, 60'000);
  const double depth = -r.summary.obstacles.at(0).translation[2];
  EXPECT_NEAR(depth / scalar(p.name, "delta"), 1, 1e-3);
  EXPECT_NEAR(r.summary.energy.total() / scalar(p.name, "E_total"), 1, 1e-3);
  EXPECT_NEAR(r.probes.at(0).values.u[2] / scalar(p.name, "uz_axis"), 1, 1e-3);
  EXPECT_NEAR(r.summary.reaction.force[2] / -p.force, 1, 1e-8);
  EXPECT_LT(r.certificate.force_balance, 1e-8);
  for (const computation::Level& level : r.levels) EXPECT_LE(level.iterations, level.linearisations * 8);
  if (p.once) return;
  // The same with a prescribed displacement.
  auto moved = problem_of({p.name, p.thickness, p.radius, depth, p.dome, p.once});
  const computation::Result other = computation::solve(moved, MPI_COMM_WORLD);
  EXPECT_NEAR(other.summary.energy.total() / r.summary.energy.total(), 1, 1e-7);
  EXPECT_NEAR(other.summary.reaction.force[2] / -p.force, 1, 1e-7);
}

// ---- plane problems ----------------------------------------------------------------------------------------------------

struct Strip {
  std::string name;
  double from, thickness, height;  ///< where it begins (it ends at 1), e, of the mid-surface
  std::string load;                ///< downward
  obstacle::Obstacle body;
  bool once;
};

obstacle::Obstacle cylinder_from_above(double depth) {
  return {.name = "cylinder",
          .shape = obstacle::Cylinder{.point = {0, 0, 2 - depth}, .axis = {0, 1, 0}, .radius = 2},
          .face = Face::upper};
}

class PlaneProblem : public testing::TestWithParam<Strip> {};
INSTANTIATE_TEST_SUITE_P(
    All, PlaneProblem,
    testing::Values(Strip{"C1strip_e0.1_d0.1", -1, 0.1, -0.05, "0", cylinder_from_above(0.1), true},
                    Strip{"C3strip_e0.1_d0.2", -1, 0.1, -0.05, "0", cylinder_from_above(0.2), false},
                    Strip{"C4shift_e0.1_A0.02_P10_S",
                          0,
                          0.1,
                          0.075,
                          "0.01",
                          {.name = "wavy", .shape = obstacle::HeightField(function("0.02*cos(6*pi*X + 0.5)"))},
                          true}),
    [](const auto& p) {
      std::string name = p.param.name;
      std::ranges::replace_if(
          name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
      return name;
    });

TEST_P(PlaneProblem, HasTheEnergyAndTheReactionOfTheReference) {
  const Strip& p = GetParam();
  problem::Problem problem;
  const double width = 0.1;
  problem.domain = domain::Rectangle{.from = {p.from, 0}, .to = {1, width}, .cells = {32, 1}};
  problem.charts.emplace("", geometry::Chart({"x", "y", "z0"}, {{"z0", p.height}}));
  problem.shell.sections.common.thickness = Expression(p.thickness);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  energy::AreaLoad load{};
  load.force = {Expression(0.0), Expression(0.0), Expression("-(" + p.load + ")", {})};
  problem.shell.loads.on_areas = {load};
  problem.shell.supports = {clamped("left"), clamped("right")};
  for (const char* edge : {"bottom", "top"})
    problem.shell.supports.push_back(
        {.boundary = edge,
         .components = {{assembly::Unknown::displacement, assembly::Direction::y, Expression(0.0)},
                        {assembly::Unknown::rotation, assembly::Direction::y, Expression(0.0)}}});
  problem.shell.obstacles.all = {p.body};
  problem.shell.obstacles.are_linear = p.once;
  problem.discretisation.degree = 4;
  problem.discretisation.refinements = 2;
  const computation::Result r = computation::solve(problem, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved);
  EXPECT_LE(r.levels.back().unknowns, 60'000);
  EXPECT_NEAR(r.summary.energy.total() / width / scalar(p.name, "E_total"), 1, 1e-3);
  EXPECT_NEAR(r.summary.reaction.force[2] / width / scalar(p.name, "reaction_z_0"), 1, 1e-3);
  EXPECT_LT(r.certificate.force_balance, 1e-8);
}

// ---- one obstacle in several forms ---------------------------------------------------------------------------------------

problem::Problem cap_over_the_table() { return contact_reference("R4cap_e0.1_p0.02", 2, 2).problem; }

obstacle::TriangleMesh slab() {
  obstacle::TriangleMesh mesh;
  for (const double z : {-1.0, 0.0})
    for (const double y : {-2.0, 3.0})
      for (const double x : {-2.5, 2.0}) mesh.points.emplace_back(x, y, z);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// The table as a half-space, and as bodies with a part of its plane as surface.
TEST(Table, in_every_form_gives_the_same_numbers) {
  const problem::Problem table = cap_over_the_table();
  const computation::Result expected = computation::solve(table, MPI_COMM_WORLD);
  ASSERT_EQ(expected.status, contact::Status::solved);
  ASSERT_GT(expected.summary.touching_nodes, 0);
  const std::vector<std::pair<const char*, obstacle::Shape>> forms{
      {"height field", obstacle::HeightField(function("0"))},
      {"distance", obstacle::DistanceField(function("Z"))},
      {"no distance", obstacle::DistanceField(function("exp(Z) - 1"))},
      {"box", obstacle::Box{.centre = {0.3, -0.2, -0.5}, .size = {5, 6, 1}}},
      {"triangles", obstacle::TriangleSurface(slab())}};
  for (const auto& [name, shape] : forms) {
    SCOPED_TRACE(name);
    problem::Problem other = table;
    other.shell.obstacles.all.at(0).shape = shape;
    const computation::Result r = computation::solve(other, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved);
    EXPECT_EQ(r.summary.touching_nodes, expected.summary.touching_nodes);
    EXPECT_NEAR(r.summary.energy.total() / expected.summary.energy.total(), 1, 1e-9);
    EXPECT_NEAR(r.summary.reaction.force[2] / expected.summary.reaction.force[2], 1, 1e-9);
  }
}

// A ball of radius R under the cap differs from the table by r^2 / 2R.
TEST(Table, is_the_limit_of_balls_that_grow) {
  const problem::Problem table = cap_over_the_table();
  const double expected = computation::solve(table, MPI_COMM_WORLD).summary.energy.total();
  double last = 0;
  for (const double radius : {1e3, 1e4, 1e5}) {
    problem::Problem other = table;
    other.shell.obstacles.all.at(0).shape = obstacle::Ball{.centre = {0, 0, -radius}, .radius = radius};
    const computation::Result r = computation::solve(other, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved);
    const double difference = std::abs(r.summary.energy.total() / expected - 1);
    EXPECT_GT(difference, 0);
    EXPECT_LT(difference, 20 / radius);
    if (last > 0) {
      EXPECT_NEAR(difference / last, 0.1, 0.02);
    }
    last = difference;
  }
}

// ---- shells that contact alone holds -----------------------------------------------------------------------------------

assembly::Support at_point(const Eigen::Vector2d& x, std::vector<assembly::Direction> directions) {
  assembly::Support support{.point = x};
  for (const auto d : directions) support.components.push_back({assembly::Unknown::displacement, d, Expression(0.0)});
  return support;
}

/// Supports prevent only sliding and spinning.
problem::Problem resting(const std::string& height, double load) {
  problem::Problem problem;
  problem.domain = domain::Disk{.radius = std::sin(0.5)};
  problem.charts.emplace("", geometry::Chart({"x", "y", height}, {}));
  problem.shell.sections.common.thickness = Expression(0.05);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  energy::AreaLoad weight{};
  weight.force = {Expression(0.0), Expression(0.0), Expression(-load)};
  problem.shell.loads.on_areas = {weight};
  problem.shell.supports = {at_point({0, 0}, {assembly::Direction::x, assembly::Direction::y}),
                            at_point({std::sin(0.5), 0}, {assembly::Direction::y})};
  problem.shell.obstacles.all = {obstacle::Obstacle{}};
  problem.discretisation.degree = 4;
  problem.discretisation.refinements = 3;
  return problem;
}

TEST(BowlThatRests, HasTheEnergyAndTheReactionOfTheReference) {
  const char* name = "C6bowl0.5_e0.05_P1";
  const computation::Result r = computation::solve(resting("1.025 - sqrt(1 - x^2 - y^2)", 1.25e-4), MPI_COMM_WORLD);
  EXPECT_EQ(r.status, contact::Status::solved) << contact::explain(r.status);
  EXPECT_NEAR(r.summary.energy.total() / scalar(name, "E_total"), 1, 1e-3);
  EXPECT_NEAR(r.summary.reaction.force[2] / scalar(name, "reaction_z_0"), 1, 1e-3);
}

TEST(DomeThatStandsOnItsRim, HasTheEnergyAndTheLineReactionOfTheReference) {
  const char* name = "C6standdome0.5_e0.05_P1";
  const computation::Result r =
      computation::solve(resting("-0.8556429978431134 + sqrt(1 - x^2 - y^2)", 1.25e-4), MPI_COMM_WORLD);
  EXPECT_EQ(r.status, contact::Status::solved) << contact::explain(r.status);
  EXPECT_NEAR(r.summary.energy.total() / scalar(name, "E_total"), 1, 1e-3);
  EXPECT_NEAR(r.summary.reaction.force[2] / scalar(name, "reaction_z_0"), 1, 1e-3);
  EXPECT_NEAR(r.summary.edge.max_per_length / scalar(name, "line_reaction"), 1, 1e-2);
  EXPECT_NEAR(r.summary.edge.force / (2 * std::numbers::pi * std::sin(0.5)) / scalar(name, "line_reaction"), 1, 1e-2);
}

}  // namespace
}  // namespace plastron::verification

// Shells against curved obstacles with known answers: energy, reaction, deflection, contact boundary, with the gap of the undeformed shell
// (M16) and with the distance of the deformed one.
#include <plastron/computation/solve.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
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

struct Indented {
  std::string name;
  double thickness, radius, depth;  ///< of the shell, of the ball, of its lowest point under the shell's highest
  bool dome;
  bool once;  ///< linearised at the undeformed shell
};

computation::Problem problem_of(const Indented& p) {
  computation::Problem problem;
  const Constants constants{{"e", p.thickness}};
  problem.domain = fem::Disk{.radius = p.dome ? std::sin(0.5) : 1.0};
  problem.charts.emplace("", p.dome ? geometry::Chart({"x", "y", "-1 - e/2 + sqrt(1 - x^2 - y^2)"}, constants)
                                    : geometry::Chart({"x", "y", "-e/2"}, constants));
  problem.sections.common.thickness = Expression(p.thickness);
  problem.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  problem.supports = {clamped("rim")};
  problem.obstacles = {{.name = "ball",
                        .shape = obstacle::Ball{.centre = {0, 0, p.radius - p.depth}, .radius = p.radius},
                        .face = Face::upper}};
  problem.linearisation.once = p.once;
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

// ---- shells that contact alone holds -----------------------------------------------------------------------------------

assembly::Support at_point(const Eigen::Vector2d& x, std::vector<assembly::Direction> directions) {
  assembly::Support support{.point = x};
  for (const auto d : directions) support.components.push_back({assembly::Unknown::displacement, d, Expression(0.0)});
  return support;
}

/// Nothing but sliding and spin is held.
computation::Problem resting(const std::string& height, double load) {
  computation::Problem problem;
  problem.domain = fem::Disk{.radius = std::sin(0.5)};
  problem.charts.emplace("", geometry::Chart({"x", "y", height}, {}));
  problem.sections.common.thickness = Expression(0.05);
  problem.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  assembly::AreaLoad weight{};
  weight.force = {Expression(0.0), Expression(0.0), Expression(-load)};
  problem.area_loads = {weight};
  problem.supports = {at_point({0, 0}, {assembly::Direction::x, assembly::Direction::y}),
                      at_point({std::sin(0.5), 0}, {assembly::Direction::y})};
  problem.obstacles = {obstacle::Obstacle{}};
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

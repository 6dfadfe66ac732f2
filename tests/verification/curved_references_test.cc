// Shells against curved obstacles with known answers: energy, reaction, deflection, contact boundary, with the gap of the undeformed shell
// (M16) and with the distance of the deformed one.
#include <plastron/computation/solve.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

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
  fmt::print("{}: energy {:+.2e} reaction {:+.2e} linearisations", p.name,
             r.summary.energy.total() / scalar(p.name, "E_total") - 1,
             r.summary.reaction.force[2] / scalar(p.name, "reaction_z_0") - 1);
  for (const computation::Level& l : r.levels)
    fmt::print(" {} ({} it, {:.1e})", l.linearisations, l.iterations, l.gap_error);
  fmt::print("\n");
  for (const computation::Level& level : r.levels) {
    EXPECT_EQ(level.linearisations > 1, !p.once);
    EXPECT_LT(level.gap_error, p.once ? p.depth : 1e-8 * p.depth);
  }
  EXPECT_LT(r.certificate.force_balance, 1e-8);
}

}  // namespace
}  // namespace plastron::verification

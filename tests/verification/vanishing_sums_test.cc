// Numbers that vanish because their terms cancel, or because the shell is at rest. Their errors are judged by the sizes of the
// terms: such cases end as soon as others, without warnings that compare rounding with rounding.
#include <plastron/computation/solve.hpp>
#include <plastron/config/case.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace plastron::vanishing_sums {
namespace {

constexpr double pi = std::numbers::pi;

computation::Result solved(const std::string& text) {
  return computation::solve(config::parse_case(text, "vanishing.toml").problem, MPI_COMM_WORLD);
}

/// Expects the accuracy that was asked for, on a small mesh, and no warning with one of these words.
void expect_quiet(const computation::Result& result) {
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_LT(result.levels.back().unknowns, 10'000);
  EXPECT_THAT(result.warnings, testing::Not(testing::Contains(testing::HasSubstr("linear model"))));
  EXPECT_THAT(result.warnings, testing::Not(testing::Contains(testing::HasSubstr("support at the point"))));
  ASSERT_TRUE(result.estimates);
  for (const estimation::GoalEstimate& goal : result.estimates->goals)
    EXPECT_LE(goal.error(), 1e-3 * goal.scale) << goal.name;
}

struct Sizes {
  double length, E;  // lengths and moduli in other units
};
constexpr Sizes all_sizes[] = {{1, 1}, {1e3, 1e-6}, {1e-3, 1e6}};

// A closed ring on a shaft that is too thick: p = E e d / R^2, and the forces of the shaft cancel.
TEST(VanishingSum, OfForcesRoundARingIsReached) {
  for (const auto& [L, E] : all_sizes) {
    const double R = 50 * L, e = L, d = 0.05 * L, width = 20 * L, modulus = 210000 * E;
    const auto result = solved(fmt::format(R"case([shell]
E = {4}
nu = 0.3
thickness = {1}
[geometry]
domain = {{ rectangle = {{ from = ["-pi", 0], to = ["pi", {3}], cells = [8, 1] }} }}
chart = ["{0}*sin(x)", "y", "-{0}*cos(x)"]
[[join]]
boundaries = ["left", "right"]
[[support]]
point = [0, 0]
fix = ["u.x", "u.y"]
[[support]]
point = ["-pi", 0]
fix = ["u.y"]
[[support]]
point = ["pi/2", 0]
fix = ["u.y"]
[[obstacle]]
name = "shaft"
cylinder = {{ axis = [0, 1, 0], radius = {2} }}
)case",
                                           R, e, R - e / 2 + d, width, modulus));
    expect_quiet(result);
    const double energy = modulus * e * std::pow(d / R, 2) * pi * R * width;
    EXPECT_NEAR(result.summary.energy.total(), energy, 0.01 * energy);
    const double pressed = modulus * e * d / (R * R) * 2 * pi * R * width;
    EXPECT_NEAR(result.summary.contact_norms(), pressed, 0.02 * pressed);
    EXPECT_LT(result.summary.reaction.force.norm(), 1e-9 * pressed);
    EXPECT_TRUE(result.singular_places.empty());  // points that carry nothing
  }
}

// A plate with held edges that is heated does not move: it stores the energy of its initial strains.
TEST(InitialStrains, StoreTheirEnergyInAHeldPlate) {
  for (const auto& [L, E] : all_sizes)
    for (const char* layers :
         {"{ material = \"st\", thickness = 1, strain = [1e-4, 1e-4, 0] }",
          "{ material = \"st\", thickness = 1, strain = [1e-4, 0, 0] }, { material = \"st\", thickness = 2 }"}) {
      const auto result = solved(fmt::format(R"case([[material]]
name = "st"
E = {0}
nu = 0.3
[[material]]
name = "hot"
layers = [{1}]
[shell]
material = "hot"
thickness = {2}
[geometry]
domain = {{ rectangle = {{ to = [{3}, {3}], cells = [4, 4] }} }}
chart = ["x", "y", "0"]
[[support]]
boundary = ["left", "right", "bottom", "top"]
fix = ["u", "r"]
)case",
                                             200000 * E, layers, 2 * L, 200 * L));
      expect_quiet(result);
      EXPECT_NEAR(result.summary.energy.total() / result.summary.initial_energy, 1, 1e-9);
    }
}

// A clamped plate that lies on a floor from the start, and one that no obstacle reaches.
// A laminate that its layers bend, and nothing holds: all forces vanish. It may lie on a table under next to no weight.
TEST(VanishingSum, OfForcesOnAFreeLaminateIsReached) {
  for (const auto& [L, E] : all_sizes)
    for (const std::string rotations : {"small", "finite"})
      for (const double weight : {0.0, 1e-5}) {
        // With small rotations the laminate rolls on the table without resistance.
        if (weight > 0 && (rotations == "small" || L != 1)) continue;
        const std::string on_table = fmt::format(R"case([[load]]
force = [0, 0, {}]
[[obstacle]]
half_space = {{ point = [0, 0, {}] }}
)case",
                                                 -weight * E, -0.5 * L);
        const auto result = solved(fmt::format(
            R"case([[material]]
name = "ply"
E1 = {1}
E2 = {2}
nu12 = 0.3
G12 = {3}
G13 = {3}
G23 = {3}
[[material]]
name = "stack"
layers = [{{ material = "ply", thickness = 1, angle = 0, strain = [1e-4, 2e-3, 0] }},
          {{ material = "ply", thickness = 1, angle = 90, strain = [1e-4, 2e-3, 0] }}]
[shell]
material = "stack"
thickness = {0}
rotations = "{4}"
[geometry]
domain = {{ rectangle = {{ to = [{5}, {6}], cells = [3, 2] }} }}
chart = ["x", "y", "0"]
[mesh]
degree = 4
refinements = 0
[[support]]
point = [0, 0]
fix = {7}
[[support]]
point = [{5}, 0]
fix = {8}
{9}
)case",
            L, 130e3 * E, 9e3 * E, 5e3 * E, rotations, 50 * L, 30 * L, weight > 0 ? R"(["u.x", "u.y"])" : R"(["u"])",
            weight > 0 ? R"(["u.y"])" : R"(["u.y", "u.z"])",
            weight > 0 ? on_table : fmt::format("[[support]]\npoint = [0, {}]\nfix = [\"u.z\"]\n", 30 * L)));
        EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits << rotations << weight;
        // Its own curvature stores nothing. With finite rotations the saddle has strains in its surface.
        const double stored = result.summary.energy.total() / (E * L * L * L);
        EXPECT_NEAR(stored, rotations == "small" ? 0 : 0.1152, 3e-3) << rotations << weight;
        EXPECT_THAT(result.warnings, testing::Not(testing::Contains(testing::HasSubstr("support at the point"))));
      }
}

TEST(VanishingSum, OfAPlateAtRestIsReached) {
  for (const double gap : {0.0, 1.0})
    for (const auto& [L, E] : all_sizes) {
      const auto result =
          solved(fmt::format(R"case([shell]
E = {0}
nu = 0.3
thickness = {1}
[geometry]
domain = {{ rectangle = {{ to = [{2}, {2}] }} }}
chart = ["x", "y", 0]
[[support]]
boundary = ["left", "right", "bottom", "top"]
fix = ["u", "r"]
[[load]]
force = [0, 0, {3}]
[[obstacle]]
half_space = {{ point = [0, 0, {4}] }}
[accuracy]
energy = 1e-3
)case",
                             70e9 * E, 0.005 * L, 0.5 * L, gap > 0 ? 0 : -20000 * E, (-0.0025 - gap) * L));
      expect_quiet(result);
      EXPECT_LE(result.summary.energy.total(), 1e-9 * result.summary.least_energy());
    }
}

}  // namespace
}  // namespace plastron::vanishing_sums

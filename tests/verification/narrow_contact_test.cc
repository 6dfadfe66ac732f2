// Contact that is narrow or alone in holding the shell: lines and points of contact are named and not ranked, and estimates cover the
// place of a zone's edge.
#include <plastron/computation/solve.hpp>
#include <plastron/config/case.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace plastron::narrow_contact {
namespace {

computation::Result solved(const std::string& text) {
  return computation::solve(config::parse_case(text, "narrow.toml").problem, MPI_COMM_WORLD);
}

/// A strip between two simple supports under a load, with an obstacle above it; or its half y > 0 with as many cells.
computation::Result pressed_strip(const std::string& obstacle, int cells, double load = 0, bool is_half = false) {
  return solved(fmt::format(R"case([shell]
E = 1
nu = 0.3
thickness = 0.05
[geometry]
domain = {{ rectangle = {{ from = [-1, {3}], to = [1, 0.5], cells = [{0}, {4}] }} }}
chart = ["x", "y", 0]
[mesh]
degree = 4
refinements = 0
[[support]]
boundary = ["left", "right"]
fix = ["u"]
{5}[[load]]
force = [0, 0, {2}]
[[obstacle]]
name = "die"
{1}
face = "upper"
[[probe]]
name = "under"
at = [0, 0]
[[probe]]
name = "beside"
at = [0.5, 0.3]
)case",
                            cells, obstacle, load, is_half ? 0 : -0.5, is_half ? cells / 2 : cells,
                            is_half ? "[[support]]\nboundary = \"bottom\"\nfix = [\"symmetry\"]\n" : ""));
}

std::vector<recovery::SingularPlace> contact_places(const computation::Result& result) {
  std::vector<recovery::SingularPlace> places = result.singular_places;
  std::erase_if(places, [](const auto& place) { return place.what.find("contact") == std::string::npos; });
  return places;
}

/// A plane of symmetry is no edge: the shell goes on beyond it.
TEST(NarrowContact, IsThatOfTheWholeOnAPlaneOfSymmetry) {
  for (const char* obstacle : {"cylinder = { axis = [0, 1, 0], radius = 0.2, point = [0, 0, 0.22] }",
                               "ball = { centre = [0, 0, 0.22], radius = 0.2 }"}) {
    const auto whole = pressed_strip(obstacle, 4), half = pressed_strip(obstacle, 4, 0, true);
    ASSERT_EQ(half.status, contact::Status::solved) << half.missed_limits;
    EXPECT_NEAR(2 * half.summary.energy.total(), whole.summary.energy.total(), 1e-9 * whole.summary.energy.total());
    EXPECT_EQ(half.summary.edge.is_line(), whole.summary.edge.is_line());
    EXPECT_EQ(contact_places(half).size(), contact_places(whole).size()) << obstacle;
    const auto error = [](const computation::Result& result) {
      const auto& goals = result.estimates->goals;
      return std::ranges::find(goals, "energy", &estimation::GoalEstimate::name)->error();
    };
    EXPECT_NEAR(2 * error(half) / error(whole), 1, 0.5) << obstacle;
  }
}

TEST(NarrowContact, IsNamedAndNotRanked) {
  using testing::HasSubstr;
  for (const int cells : {4, 8})
    for (const char* obstacle : {"cylinder = { axis = [0, 1, 0], radius = 0.2, point = [0, 0, 0.22] }",
                                 "ball = { centre = [0, 0, 0.22], radius = 0.2 }"}) {
      const auto result = pressed_strip(obstacle, cells);
      ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
      ASSERT_GT(result.summary.touching_nodes, 0);
      const auto places = contact_places(result);
      ASSERT_EQ(places.size(), 1u) << obstacle;
      const recovery::SingularPlace& place = places[0];
      EXPECT_THAT(place.what, HasSubstr("of contact with \"die\""));
      EXPECT_NEAR(place.position[0], 0, 1e-9);
      EXPECT_FALSE(place.is_near(result.peak.position));
      for (const computation::ProbeValue& probe : result.probes)
        EXPECT_EQ(place.is_near(probe.values.phi), probe.name == "under") << probe.name;
    }
}

TEST(WideContact, IsRanked) {
  const auto result = pressed_strip("half_space = { point = [0, 0, 0.03], normal = [0, 0, -1] }", 4, 1e-4);
  ASSERT_GT(result.summary.touching_nodes, 0);
  EXPECT_TRUE(contact_places(result).empty());
}

struct Bowl {
  double thickness, load, energy;  // energies of fine meshes, to six digits
};

// Bowls that lie on a table and are held by nothing else: the energy depends on the edge of the zone in the first order.
TEST(Bowl, ThatATableAloneHoldsHasTheEnergyThatIsAskedFor) {
  for (const Bowl& bowl : {Bowl{0.05, 0.00125, 1.452551205e-5}, Bowl{0.1, 0.01, 8.600592197e-5}})
    for (const double tolerance : {1e-2, 1e-3}) {
      const auto result = solved(fmt::format(R"case([shell]
E = 1
nu = 0.3
thickness = {0}
[geometry]
domain = {{ disk = {{ radius = "sin(0.5)" }} }}
chart = ["x", "y", "1 + {0}/2 - sqrt(1 - x^2 - y^2)"]
[accuracy]
energy = {2}
[model]
check = false
[[support]]
boundary = "rim"
fix = ["u.t"]
[[load]]
force = [0, 0, -{1}]
[[obstacle]]
half_space = {{ point = [0, 0, 0], normal = [0, 0, 1] }}
face = "lower"
)case",
                                             bowl.thickness, bowl.load, tolerance));
      EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
      EXPECT_NEAR(result.summary.energy.total(), bowl.energy, tolerance * bowl.energy) << bowl.thickness;
    }
}

}  // namespace
}  // namespace plastron::narrow_contact

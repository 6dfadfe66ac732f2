// [[support]]: components, values and symmetry.
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>

namespace plastron::config {
namespace {

using assembly::Direction;
using assembly::Unknown;

std::vector<assembly::Support> supports(const std::string& text) {
  return parse_case(
             "[shell]\nE = 1\nnu = 0\nthickness = 1\n[geometry]\ndomain = { rectangle = { to = [1, 1] } }\n"
             "chart = [\"x\", \"y\", 0]\n[[support]]\nboundary = \"left\"\n" +
                 text,
             "case.toml")
      .problem.shell.supports;
}

// "u.x = 0" and so on, for one support.
std::vector<std::string> listed(const assembly::Support& support) {
  const std::vector<std::string> directions{"x", "y", "z", "n", "t", "a3"};
  std::vector<std::string> all;
  for (const auto& c : support.components)
    all.push_back(std::string(c.unknown == Unknown::displacement ? "u." : "r.") +
                  directions[static_cast<std::size_t>(c.direction)] + " = " + c.value.text());
  return all;
}

using List = std::vector<std::string>;

TEST(Support, OfUAndRIsSixCartesianComponents) {
  const auto clamped = supports("fix = [\"u\", \"r\"]\n").at(0);
  EXPECT_EQ(clamped.boundary, "left");
  EXPECT_EQ(listed(clamped), (List{"u.x = 0", "u.y = 0", "u.z = 0", "r.x = 0", "r.y = 0", "r.z = 0"}));
  EXPECT_FALSE(clamped.symmetry);
}

TEST(Support, TakesComponentsAlongTheEdgeAndTheNormal) {
  EXPECT_EQ(listed(supports("fix = [\"u.n\", \"u.t\", \"u.a3\", \"r.n\", \"r.t\"]\n").at(0)),
            (List{"u.n = 0", "u.t = 0", "u.a3 = 0", "r.n = 0", "r.t = 0"}));
}

TEST(Support, OfSymmetryIsTheConormalComponents) {
  const auto support = supports("fix = [\"symmetry\", \"u.z\"]\n").at(0);
  EXPECT_EQ(listed(support), (List{"u.n = 0", "r.n = 0", "u.z = 0"}));
  EXPECT_TRUE(support.symmetry);
}

TEST(SupportValues, MayBeDottedQuotedOrAVector) {
  const List expected{"u.x = 0", "u.y = 0", "u.z = -0.01*y"};
  EXPECT_EQ(listed(supports("fix = [\"u\"]\nvalues = { u.z = \"-0.01*y\" }\n").at(0)), expected);
  EXPECT_EQ(listed(supports("fix = [\"u\"]\nvalues = { \"u.z\" = \"-0.01*y\" }\n").at(0)), expected);
  EXPECT_EQ(listed(supports("fix = [\"u\"]\nvalues = { u = [0, 0, \"-0.01*y\"] }\n").at(0)), expected);
  EXPECT_EQ(listed(supports("fix = [\"u\"]\nvalues.u.z = \"-0.01*y\"\n").at(0)), expected);
  EXPECT_EQ(listed(supports("fix = [\"u\"]\n[support.values]\nu.z = \"-0.01*y\"\n").at(0)), expected);
}

TEST(Supports, OfAListAreOnePerBoundary) {
  const auto all = supports("fix = [\"u.z\"]\n[[support]]\nboundary = [\"top\", \"right\"]\nfix = [\"u.n\"]\n");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].boundary, "top");
  EXPECT_EQ(all[2].boundary, "right");
  EXPECT_EQ(listed(all[2]), List{"u.n = 0"});
}

TEST(Supports, MayHoldPoints) {
  const auto all =
      supports("fix = [\"u.z\"]\n[[support]]\npoint = [1, 0.5]\nfix = [\"u.x\", \"u.z\"]\nvalues = { u.z = 2 }\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_FALSE(all[0].point);
  EXPECT_EQ(all[1].boundary, "");
  EXPECT_EQ(all[1].point, Eigen::Vector2d(1, 0.5));
  EXPECT_EQ(listed(all[1]), (List{"u.x = 0", "u.z = 2"}));
}

TEST(Supports, OfOneBoundaryMayBeSplit) {
  const auto split = supports("fix = [\"u\"]\n[[support]]\nboundary = \"left\"\nfix = [\"r.t\"]\n");
  ASSERT_EQ(split.size(), 2u);
  EXPECT_EQ(listed(split[1]), List{"r.t = 0"});
}

}  // namespace
}  // namespace plastron::config

// [[step]] and [[step.move]] as they are read.
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>

#include <numbers>

namespace plastron::config {
namespace {

using Eigen::Vector3d;

problem::Problem problem_with(const std::string& lines) {
  return parse_case(
             "[shell]\nE = 1\nnu = 0\nthickness = 1\n[geometry]\ndomain = { disk = { radius = 1 } }\n"
             "chart = [\"x\", \"y\", 0]\n[[obstacle]]\nname = \"floor\"\nhalf_space = {}\nface = \"both\"\n"
             "[[obstacle]]\nname = \"tool\"\nball = { radius = 1, centre = [0, 0, 3] }\nforce = [0, 0, -2]\n" +
                 lines,
             "case.toml")
      .problem;
}

TEST(ACaseWithoutSteps, HasNone) {
  const auto problem = problem_with("");
  EXPECT_TRUE(problem.steps.empty());
  EXPECT_TRUE(problem.shell.obstacles.all.back().is_pressed());
  EXPECT_TRUE(problem.shell.obstacles.all.back().motions.empty());
}

TEST(Steps, KeepLoadsAndForcesUntilTheyAreGivenAnew) {
  const auto problem = problem_with(
      "[[step]]\nloads = 0.5\nsupports = -1\n[[step.move]]\nobstacle = \"tool\"\nforce = 0\n[[step]]\nname = "
      "\"press\"\nparts = 4\n"
      "[[step.move]]\nobstacle = \"tool\"\nforce = 3\n[[step]]\nloads = 2\n");
  ASSERT_EQ(problem.steps.size(), 3U);
  EXPECT_EQ(problem.steps[0].name, "step-1");
  EXPECT_EQ(problem.steps[1].name, "press");
  EXPECT_EQ(problem.steps[1].parts, 4);
  EXPECT_EQ(problem.steps[0].factors.loads, 0.5);
  EXPECT_EQ(problem.steps[1].factors.loads, 0.5);
  EXPECT_EQ(problem.steps[2].factors.loads, 2);
  EXPECT_EQ(problem.steps[0].factors.supports, -1);
  EXPECT_EQ(problem.steps[2].factors.supports, -1);
  EXPECT_EQ(problem.steps[0].factors.forces, std::vector<double>({1, 1, 0}));
  EXPECT_EQ(problem.steps[1].factors.forces, std::vector<double>({1, 1, 3}));
  EXPECT_EQ(problem.steps[2].factors.forces, std::vector<double>({1, 1, 3}));
}

TEST(Envelopes, AreOverAllCasesIfTheyNameNone) {
  const auto envelopes =
      problem_with("[[case]]\nname = \"a\"\n[[case]]\n[[envelope]]\n[[envelope]]\nname = \"one\"\ncases = [\"a\"]\n")
          .output.envelopes;
  ASSERT_EQ(envelopes.size(), 2U);
  EXPECT_EQ(envelopes[0].name, "envelope-1");
  EXPECT_EQ(envelopes[0].cases, std::vector<std::string>({"a", "case-2"}));
  EXPECT_EQ(envelopes[1].name, "one");
  EXPECT_EQ(envelopes[1].cases, std::vector<std::string>({"a"}));
}

TEST(Parts, AreANumberOrChosen) {
  EXPECT_EQ(problem_with("[[step]]\nparts = 3\n").steps[0].parts, 3);
  EXPECT_FALSE(problem_with("[[step]]\nparts = 3\n").steps[0].chooses_parts);
  EXPECT_TRUE(problem_with("[[step]]\nparts = \"auto\"\n").steps[0].chooses_parts);
  EXPECT_EQ(problem_with("[[step]]\nparts = 3\n[[step]]\nparts = \"auto\"\n").steps[1].parts, 1);
  EXPECT_THROW(problem_with("[[step]]\nparts = \"many\"\n"), CaseErrors);
  EXPECT_THROW(problem_with("[[step]]\nparts = 0.5\n"), CaseErrors);
}

TEST(Moves, GoOnFromWhereTheStepBeforeHasLeftTheObstacle) {
  const auto problem = problem_with(
      "[[step]]\n[[step.move]]\nobstacle = \"tool\"\nrotate = { axis = [0, 2, 0], angle = \"pi/2\" }\n[[step]]\n"
      "[[step.move]]\nobstacle = \"tool\"\ntranslate = [0, 0, 1]\n[[step.move]]\nobstacle = \"floor\"\n"
      "translate = [0, 0, 5]\n");
  const obstacle::Obstacle& tool = problem.shell.obstacles.all.back();
  EXPECT_NEAR(tool.standing(1).nearest({3, 0, 0}).distance, -1, 1e-15);
  EXPECT_NEAR(tool.standing(2).nearest({3, 0, 1}).distance, -1, 1e-15);
  for (int face : {0, 1}) {  // both faces' obstacles move
    EXPECT_NEAR(problem.shell.obstacles.all[static_cast<std::size_t>(face)].standing(1).nearest({0, 0, 0}).distance, 0,
                1e-15);
    EXPECT_NEAR(problem.shell.obstacles.all[static_cast<std::size_t>(face)].standing(2).nearest({0, 0, 0}).distance, -5,
                1e-15);
  }
}

}  // namespace
}  // namespace plastron::config

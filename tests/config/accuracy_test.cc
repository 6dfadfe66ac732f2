// [accuracy]: the possible goals, and the default of a case without it.
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>

namespace plastron::config {
namespace {

Case with(const std::string& sections) {
  return parse_case(
      "[shell]\nE = 1\nnu = 0\nthickness = 0.1\n[geometry]\ndomain = { disk = { radius = 1 } }\n"
      "chart = [\"x\", \"y\", 0]\n[[support]]\nboundary = \"rim\"\nfix = [\"u\"]\n"
      "[[obstacle]]\nhalf_space = {}\nname = \"table\"\n[[probe]]\nname = \"centre\"\nat = [0, 0]\n" +
          sections,
      "case.toml");
}

using Goals = std::vector<std::pair<std::string, double>>;

Goals goals_of(const Case& c) {
  Goals goals;
  for (const auto& goal : c.problem.accuracy.value().goals) goals.emplace_back(goal.name, goal.tolerance);
  return goals;
}

TEST(Accuracy, IsADefaultWhereNothingIsSaidOfMeshes) {
  const Case c = with("");
  EXPECT_EQ(goals_of(c), (Goals{{"energy", 1e-3}, {"reaction", 1e-3}}));
  EXPECT_EQ(c.problem.discretisation.refinements, 0);
  EXPECT_EQ(c.problem.discretisation.degree, 4);
}

TEST(Accuracy, GivesWayToAMesh) {
  const Case c = with("[mesh]\nrefinements = 2\n");
  EXPECT_FALSE(c.problem.accuracy);
  EXPECT_EQ(c.problem.discretisation.degree, 2);
}

TEST(Accuracy, StandsBesideAMeshThatItBeginsWith) {
  const Case c = with("[mesh]\ncells = \"triangle\"\n[accuracy]\ncontact_area = 1e-2\n");
  EXPECT_EQ(goals_of(c), (Goals{{"contact_area", 1e-2}}));
  EXPECT_EQ(c.problem.discretisation.refinements, 0);
  EXPECT_EQ(c.problem.discretisation.degree, 2);
}

TEST(Accuracy, TakesNumbersByTheirNamesInTheOrderOfTheFile) {
  const Case c = with(
      "[accuracy]\n\"probe.centre.u.z\" = \"1e-2/2\"\nenergy = 1e-4\n\"obstacle.table.force.z\" = 1e-3\n"
      "\"support.rim.force\" = 0.1\nmax_unknowns = 5000\nmax_seconds = 7\n");
  EXPECT_EQ(
      goals_of(c),
      (Goals{
          {"energy", 1e-4}, {"probe.centre.u.z", 5e-3}, {"obstacle.table.force.z", 1e-3}, {"support.rim.force", 0.1}}));
  EXPECT_EQ(c.problem.accuracy->max_unknowns, 5000);
  EXPECT_EQ(c.problem.accuracy->max_seconds, 7);
  EXPECT_EQ(c.effective["accuracy"]["probe.centre.u.z"], 5e-3);
}

TEST(Accuracy, WithLimitsAloneKeepsTheDefaultGoals) {
  EXPECT_EQ(goals_of(with("[accuracy]\nmax_unknowns = 1e4\n")), (Goals{{"energy", 1e-3}, {"reaction", 1e-3}}));
}

}  // namespace
}  // namespace plastron::config

// A claim needs evidence. A shell without contact or motion, a measurement that is rounding, or a single mesh cannot judge it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <research/study/kinds.hpp>

#include <algorithm>

#include "computation/problems.hpp"
#include "research/tables.hpp"

namespace plastron::study {
namespace {

using namespace test;

using testing::HasSubstr;

Report run(const std::string& name, const problem::Problem& problem, const StudyOptions& options = {}) {
  const Kind& kind = name == "compare" ? comparison() : *find_kind(name);
  return kind.run(problem, options, MPI_COMM_SELF, {});
}

/// A shallow shell, clamped at one side, without load.
problem::Problem unloaded() {
  problem::Problem p = with_chart(cantilever_plate(), {"x", "y", "0.2*x^2 + 0.1*y^2"});
  p.shell.loads.on_areas.clear();
  return p;
}

/// A strip so far above the table that it does not reach it.
problem::Problem strip_in_the_air() {
  problem::Problem p = pressed_strip();
  std::get<obstacle::HalfSpace>(p.shell.obstacles.all.at(0).shape).point = {0, 0, -1};
  p.discretisation.refinements = 1;
  return p;
}

TEST(Claim, SpeaksOneOfThreeVerdicts) {
  EXPECT_EQ(judged("a", "b", true).verdict, Verdict::holds);
  EXPECT_EQ(judged("a", "b", false).verdict, Verdict::does_not_hold);
  EXPECT_EQ(not_judged("a", "why").verdict, Verdict::cannot_be_judged);
  EXPECT_EQ(to_string(Verdict::cannot_be_judged), "cannot be judged");
}

TEST(EveryStudy, OfAShellThatDoesNotMoveCanJudgeNoSolution) {
  for (const std::string name : {"convergence", "penalty", "thickness", "continuity", "compare"}) {
    SCOPED_TRACE(name);
    const Report report = run(name, unloaded(), few_samples());
    EXPECT_EQ(report.status, contact::Status::solved);
    ASSERT_FALSE(report.table.claims.empty());
    for (const Claim& claim : report.table.claims) {
      if (claim.statement.starts_with("the load")) continue;  // random loads move it
      EXPECT_EQ(claim.verdict, Verdict::cannot_be_judged) << claim.statement << ": " << claim.measured;
    }
  }
}

TEST(EveryStudy, OfAShellThatMovesRigidlyCanJudgeNoSolution) {
  problem::Problem p = unloaded();
  p.shell.supports.front().components[2].value = Expression(0.3);
  for (const std::string name : {"convergence", "penalty", "thickness", "compare"}) {
    SCOPED_TRACE(name);
    for (const Claim& claim : run(name, p, few_samples()).table.claims)
      EXPECT_EQ(claim.verdict, Verdict::cannot_be_judged) << claim.statement << ": " << claim.measured;
  }
}

TEST(EveryStudy, OnOneMeshAndWithOneThicknessCannotJudgeHowThingsChange) {
  problem::Problem p = pressed_strip();
  p.discretisation.refinements = 0;
  StudyOptions options = few_samples();
  options.factors = {1};
  for (const std::string name : {"convergence", "thickness", "stability", "compare"}) {
    SCOPED_TRACE(name);
    expect_none_judged(run(name, p, options).table, "");
  }
}

TEST(Convergence, OfAStripInTheAirSaysNothingOfContact) {
  const Table table = run("convergence", strip_in_the_air(), few_samples()).table;
  EXPECT_EQ(claim_on(table, "without obstacle: the error").verdict, Verdict::holds);
  for (const std::string part : {"with obstacle: the error in", "Falk"}) {
    EXPECT_EQ(claim_on(table, part).verdict, Verdict::cannot_be_judged);
    EXPECT_THAT(claim_on(table, part).reason, HasSubstr("does not touch"));
  }
}

// Where a clamped edge meets free ones the solution is not smooth, and its error falls more slowly than the degree promises.
TEST(Convergence, OfAShellWithCornersDoesNotHaveTheOrderOfSmoothSolutions) {
  problem::Problem p = cantilever_plate();
  p.discretisation.degree = 3;
  const Table table = run("convergence", p, few_samples()).table;
  EXPECT_EQ(claim_on(table, "falls from mesh to mesh").verdict, Verdict::holds);
  EXPECT_EQ(claim_on(table, "Cea").verdict, Verdict::does_not_hold) << claim_on(table, "Cea").measured;
}

// An evenly stretched plate: its strains are in every space.
TEST(Convergence, WhoseErrorsAreRoundingSaysSo) {
  problem::Problem p = free_plate();
  p.shell.supports = {held("left", {Direction::x}), held("bottom", {Direction::y, Direction::z})};
  p.shell.supports.push_back({.boundary = "left", .components = {fixed(Unknown::displacement, Direction::z)}});
  p.shell.loads.on_edges = {{.boundary = "right", .force = vector(1, 0, 0), .couple = vector(0, 0, 0)}};
  const Table table = run("convergence", p, few_samples()).table;
  expect_none_judged(table, "rounding");
  EXPECT_TRUE(std::isnan(table.fits.front().exponent));
}

TEST(Continuity, OfAStripInTheAirSaysNothingOfTheObstaclesHeight) {
  const Table table = run("continuity", strip_in_the_air(), few_samples()).table;
  EXPECT_EQ(claim_on(table, "obstacle").verdict, Verdict::cannot_be_judged);
  EXPECT_EQ(claim_on(table, "load").verdict, Verdict::holds);
  for (const double ratio : numbers(table, "ratio", "height")) EXPECT_TRUE(std::isnan(ratio));
}

TEST(Continuity, GivesTheReasonForAKindThatItLeavesOut) {
  problem::Problem p = pressed_strip();
  p.shell.supports = {held("left", {Direction::x, Direction::y}), held("right", {Direction::y})};
  const Claim load = claim_on(run("continuity", p, few_samples()).table, "load");
  EXPECT_EQ(load.verdict, Verdict::cannot_be_judged);
  EXPECT_THAT(load.reason, HasSubstr("rigid motion"));
}

// A plate that is stretched in its plane does not rotate.
TEST(Thickness, WithoutRotationSaysNothingOfKoiters) {
  problem::Problem p = free_plate();
  p.shell.supports = {clamped("left")};
  p.shell.loads.on_areas = {force(1, 0, 0)};
  const Table table = run("thickness", p, few_samples()).table;
  EXPECT_EQ(claim_on(table, "Koiter").verdict, Verdict::cannot_be_judged);
  EXPECT_EQ(claim_on(table, "stiffness").verdict, Verdict::holds);
}

TEST(Thickness, IsJudgedByTheWholeEnergyInRelaxedFormulations) {
  problem::Problem p = with_chart(cantilever_plate(), {"x", "y", "0.2*x^2 + 0.1*y^2"});
  p.shell.tangency.formulation = element::Formulation::penalised;
  const Claim claim = claim_on(run("thickness", p, few_samples()).table, "stiffness");
  EXPECT_EQ(claim.verdict, Verdict::holds) << claim.measured << claim.reason;
}

TEST(Stability, WithoutObstacleOrHeldRotationSaysSo) {
  problem::Problem p = cantilever_plate();
  p.shell.supports = {held("left", {Direction::x, Direction::y, Direction::z}), held("right", {Direction::z})};
  const Table table = run("stability", p, few_samples()).table;
  EXPECT_THAT(claim_on(table, "beta_b").reason, HasSubstr("no support holds a rotation"));
  EXPECT_THAT(claim_on(table, "beta_c").reason, HasSubstr("without obstacle"));
  EXPECT_EQ(claim_on(table, "alpha").verdict, Verdict::holds);
}

// On a flat shell all soft modes are in the space. Their stiffness is rounding, and rounding has no order.
TEST(SoftModesStudy, OfAPlateCountsThemAndSaysNothingOfTheirOrder) {
  const Table table = run("soft-modes", free_plate()).table;
  EXPECT_EQ(claim_on(table, "tangent: the soft modes are").verdict, Verdict::holds);
  EXPECT_EQ(claim_on(table, "tangent: the soft modes become").verdict, Verdict::cannot_be_judged);
  EXPECT_THAT(claim_on(table, "tangent: the soft modes become").reason, HasSubstr("rounding"));
}

TEST(Compare, OfEqualSolutionsSaysNothing) { expect_none_judged(run("compare", cantilever_plate()).table, "noise"); }

// On a fine mesh the error of p = 1 is larger than that of the mesh.
TEST(Compare, FindsAPenaltyTooWeakForTheMesh) {
  problem::Problem p = with_chart(cantilever_plate(), {"x", "y", "0.5*x^2 + 0.3*y^2"});
  p.shell.supports = {clamped("left"), clamped("right"), clamped("bottom"), clamped("top")};
  p.shell.sections.common.thickness = Expression(0.2);
  p.discretisation.degree = 6;
  p.discretisation.refinements = 2;
  p.shell.tangency.penalty = 1;
  const Claim claim = claim_on(run("compare", p).table, "penalised");
  EXPECT_EQ(claim.verdict, Verdict::does_not_hold) << claim.measured << claim.reason;
}

// ---- errors of the examination -------------------------------------------------------------------------------------

std::vector<std::string> errors(const std::string& name, const problem::Problem& problem,
                                const StudyOptions& options = {}) {
  std::vector<std::string> texts;
  for (const examination::Finding& f : study::examine(*find_kind(name), problem, options))
    if (f.severity == examination::Severity::error) texts.push_back(f.text);
  return texts;
}

TEST(EveryStudy, StopsWithTheMessageOfRun) {
  problem::Problem p = cantilever_plate();
  p.shell.supports.clear();
  const auto of_run = examination::examine(p);
  ASSERT_TRUE(examination::has_errors(of_run));
  for (const Kind& kind : kinds()) {
    const auto findings = study::examine(kind, p, {});
    ASSERT_EQ(findings.size(), of_run.size()) << kind.name;
    for (std::size_t i = 0; i < findings.size(); ++i) EXPECT_EQ(findings[i].text, of_run[i].text);
  }
}

TEST(Penalty, IsStoppedWhereThePenalisedFormulationIsRefused) {
  problem::Problem p = cantilever_plate();
  p.shell.supports = {held("left", {Direction::x, Direction::y, Direction::z}), held("right", {Direction::z})};
  EXPECT_TRUE(errors("convergence", p).empty());
  EXPECT_THAT(errors("penalty", p), testing::ElementsAre(HasSubstr("sees only the gradient of r . a3")));
}

TEST(Thickness, IsStoppedWhereAFactorMakesTheShellTooThick) {
  problem::Problem p = with_chart(cantilever_plate(), {"sin(x)", "y", "cos(x)"});
  StudyOptions options;
  options.factors = {30, 1};
  for (const std::string name : {"thickness", "stability"})
    EXPECT_THAT(errors(name, p, options),
                testing::ElementsAre(testing::AllOf(HasSubstr("30 times"), HasSubstr("too thick"))));
  EXPECT_TRUE(errors("thickness", p).empty());
}

TEST(Options, AreThoseOfTheStudiesThatTakeThem) {
  EXPECT_TRUE(takes_option(*find_kind_name("convergence"), "reference"));
  EXPECT_FALSE(takes_option(*find_kind_name("convergence"), "samples"));
  EXPECT_EQ(kinds_that_take("factors"), "thickness, stability");
  EXPECT_EQ(kinds_that_take("output"), "");
}

}  // namespace
}  // namespace plastron::study

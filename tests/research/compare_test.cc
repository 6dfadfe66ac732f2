// plastron compare and the penalty study: what their tables say.
#include <research/referees/solvers.hpp>
#include <research/study/studies.hpp>

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "computation/problems.hpp"
#include "research/tables.hpp"

namespace plastron::study {
namespace {

using namespace test;

double number(const Table& table, std::size_t row, const std::string& column) {
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (table.columns[c].name == column) {
      const Entry& entry = table.rows[row][c];
      return std::holds_alternative<double>(entry) ? std::get<double>(entry)
                                                   : static_cast<double>(std::get<std::int64_t>(entry));
    }
  ADD_FAILURE() << "no column " << column;
  return 0;
}

std::set<std::string> formulations_of(const Table& table) {
  std::set<std::string> names;
  for (const auto& row : table.rows) names.insert(std::get<std::string>(row[0]));
  return names;
}

TEST(Compare, PutsAllFormulationsOfABowlSideBySide) {
  problem::Problem p = pressed_bowl();
  p.discretisation.refinements = 2;
  const Report report = compare(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(report.status, contact::Status::solved);
  ASSERT_EQ(report.table.rows.size(), 12U);
  EXPECT_EQ(formulations_of(report.table), (std::set<std::string>{"tangent", "penalised", "mixed", "classical"}));
  expect_all_hold(report.table);
  EXPECT_EQ(report.table.claims.size(), 3U);
  for (std::size_t f = 0; f < 4; ++f) {
    const std::size_t finest = 3 * f + 2;
    constexpr std::array width{5, 6, 7, 5};
    EXPECT_EQ(number(report.table, finest, "unknowns"), number(report.table, 2, "unknowns") / 5 * width[f]);
    EXPECT_NEAR(number(report.table, finest, "energy") / number(report.table, 2, "energy"), 1, 0.02);
    EXPECT_NEAR(number(report.table, finest, "reaction") / number(report.table, 2, "reaction"), 1, 0.02);
  }
  EXPECT_GT(number(report.table, 8, "multiplier"), 0);
  EXPECT_LT(number(report.table, 11, "normal_rotation"), 1e-12);  // the classical rotation is tangent everywhere
}

void expect_that_all_solvers_agree(const problem::Problem& p) {
  const Report report = compare_solvers(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(report.status, contact::Status::solved);
  ASSERT_EQ(report.table.rows.size(), referees::all_solvers.size());
  EXPECT_EQ(report.table.claims.size(), 2 * referees::all_solvers.size() - 1);
  expect_all_hold(report.table);
  for (std::size_t s = 0; s < report.table.rows.size(); ++s) {
    EXPECT_EQ(std::get<std::string>(report.table.rows[s][0]), referees::all_solvers[s].name);
    EXPECT_EQ(std::get<std::string>(report.table.rows[s].back()), "holds");
    EXPECT_GE(number(report.table, s, "factorisations"), 1);
  }
  // Whoever solves with one factorisation a mesh is none of the others.
  EXPECT_EQ(number(report.table, 3, "factorisations"), p.discretisation.refinements + 1);
  EXPECT_GT(number(report.table, 0, "factorisations"), p.discretisation.refinements + 1);
}

TEST(CompareSolvers, FindsThatAllSolversLayABowlAlike) {
  problem::Problem p = pressed_bowl();
  p.discretisation.refinements = 1;
  expect_that_all_solvers_agree(p);
}

TEST(CompareSolvers, FindsThatAllSolversLayABowlAlikeInTheMixedFormulation) {
  problem::Problem p = pressed_bowl();
  p.discretisation.refinements = 1;
  p.shell.tangency.formulation = element::Formulation::mixed;
  const Report report = compare_solvers(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(report.status, contact::Status::solved);
  expect_all_hold(report.table);
}

TEST(Compare, LeavesOutWhatTheCaseRulesOutAndSaysWhy) {
  problem::Problem p = cantilever_plate();
  p.shell.supports = {held("left", {Direction::x, Direction::y, Direction::z}), held("right", {Direction::z})};
  const Report report = compare(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(report.status, contact::Status::solved);
  EXPECT_EQ(formulations_of(report.table), (std::set<std::string>{"tangent", "classical"}));
  EXPECT_NE(report.table.remarks.front().find("penalised left out"), std::string::npos);
  EXPECT_NE(report.table.remarks.front().find("seventh motion"), std::string::npos);
}

TEST(Compare, OfATangentNormalAloneHoldsTheRelaxedFormulations) {
  problem::Problem p = cantilever_plate();
  p.shell.supports = {held("left", {Direction::x, Direction::y, Direction::z}), held("right", {Direction::z})};
  p.shell.supports.push_back({.boundary = "top", .components = {fixed(Unknown::rotation, Direction::normal)}});
  const Report report = compare(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(formulations_of(report.table).size(), 4U);
  for (std::size_t row = 0; row < report.table.rows.size(); ++row)
    EXPECT_NEAR(number(report.table, row, "energy") / number(report.table, row % 2, "energy"), 1, 1e-8);
}

TEST(Penalty, FollowsPUntilTheMeshLocks) {
  problem::Problem p = pressed_bowl();
  p.discretisation.degree = 4;
  p.discretisation.refinements = 1;
  const Table table = penalty(p, {}, MPI_COMM_WORLD, {}).table;
  ASSERT_GT(table.rows.size(), 4U);
  ASSERT_EQ(table.claims.size(), 2U);
  EXPECT_EQ(table.claims[0].verdict, Verdict::holds) << table.claims[0].measured;
  EXPECT_GT(table.fits.front().exponent, 0.6);
  EXPECT_NEAR(number(table, 1, "penalty"), 0.1, 1e-15);
  EXPECT_NEAR(number(table, 1, "normal_rotation") / number(table, 0, "normal_rotation"), 0.1, 0.03);
  // Locking: from p = 1 on, a smaller p is farther from the tangent solution, and much farther on the mesh before.
  EXPECT_EQ(table.claims[1].verdict, Verdict::cannot_be_judged) << table.claims[1].measured;
  EXPECT_NE(table.claims[1].reason.find("the elements lock"), std::string::npos) << table.claims[1].reason;
  for (const std::size_t row : {1U, 2U, 3U}) {
    EXPECT_GT(number(table, row, "to tangent"), number(table, row - 1, "to tangent"));
    EXPECT_GT(number(table, row, "mesh before"), 2 * number(table, row, "to tangent"));
  }
}

/// Clamped along the whole boundary, with a polynomial chart: the discrete space has fields with r . a_3 = 0 everywhere.
problem::Problem curved_plate() {
  problem::Problem p = with_chart(cantilever_plate(), {"x", "y", "0.5*x^2 + 0.3*y^2"});
  p.shell.supports = {clamped("left"), clamped("right"), clamped("bottom"), clamped("top")};
  p.shell.sections.common.thickness = Expression(0.2);
  p.discretisation.degree = 6;
  return p;
}

TEST(Penalty, ApproachesTheTangentSolutionWhereTheMeshAllows) {
  const Table table = penalty(curved_plate(), {}, MPI_COMM_WORLD, {}).table;
  expect_all_hold(table);
  EXPECT_LT(number(table, 1, "to tangent"), 0.2 * number(table, 0, "to tangent"));
  // Here U_p converges on the mesh: each p changes it by a tenth of the change before.
  ASSERT_GT(table.rows.size(), 8U);
  for (std::size_t row = 5; row < 8; ++row)
    EXPECT_NEAR(number(table, row, "change") / number(table, row - 1, "change"), 0.1, 0.01);
}

TEST(Penalty, OnOneMeshDoesNotTakeLockingForAFailure) {
  problem::Problem p = curved_plate();
  p.discretisation.refinements = 0;
  const Claim claim = penalty(p, {}, MPI_COMM_WORLD, {}).table.claims.at(1);
  EXPECT_EQ(claim.verdict, Verdict::cannot_be_judged) << claim.measured;
  EXPECT_NE(claim.reason.find("one mesh"), std::string::npos) << claim.reason;
}

TEST(Penalty, DoesNothingOnAFlatShell) {
  problem::Problem p = cantilever_plate();
  const Report report = penalty(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(report.table.rows.size(), 3U);
  EXPECT_NE(report.table.remarks.back().find("takes no part"), std::string::npos);
  expect_none_judged(report.table, "takes no part");
}

}  // namespace
}  // namespace plastron::study

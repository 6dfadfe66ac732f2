// plastron compare and the penalty study: what their tables say.
#include <plastron/study/compare.hpp>
#include <plastron/study/penalty.hpp>

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "computation/problems.hpp"
#include "study/tables.hpp"

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
  computation::Problem p = pressed_bowl();
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

TEST(Compare, LeavesOutWhatTheCaseRulesOutAndSaysWhy) {
  computation::Problem p = cantilever_plate();
  p.supports = {held("left", {Direction::x, Direction::y, Direction::z}), held("right", {Direction::z})};
  const Report report = compare(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(report.status, contact::Status::solved);
  EXPECT_EQ(formulations_of(report.table), (std::set<std::string>{"tangent", "classical"}));
  EXPECT_NE(report.table.remarks.front().find("penalised left out"), std::string::npos);
  EXPECT_NE(report.table.remarks.front().find("seventh motion"), std::string::npos);
}

TEST(Compare, OfATangentNormalAloneHoldsTheRelaxedFormulations) {
  computation::Problem p = cantilever_plate();
  p.supports = {held("left", {Direction::x, Direction::y, Direction::z}), held("right", {Direction::z})};
  p.supports.push_back({.boundary = "top", .components = {fixed(Unknown::rotation, Direction::normal)}});
  const Report report = compare(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(formulations_of(report.table).size(), 4U);
  for (std::size_t row = 0; row < report.table.rows.size(); ++row)
    EXPECT_NEAR(number(report.table, row, "energy") / number(report.table, row % 2, "energy"), 1, 1e-8);
}

TEST(Penalty, FollowsPUntilRoundingDecides) {
  computation::Problem p = pressed_bowl();
  p.discretisation.degree = 4;
  p.discretisation.refinements = 1;
  const Report report = penalty(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(report.status, contact::Status::solved);
  ASSERT_GT(report.table.rows.size(), 4U);
  ASSERT_EQ(report.table.claims.size(), 2U);
  EXPECT_EQ(report.table.claims[0].verdict, Verdict::holds) << report.table.claims[0].measured;
  // On a mesh this coarse locking still moves U_p when p is small; the claim on that is judged, and need not hold.
  EXPECT_NE(report.table.claims[1].verdict, Verdict::cannot_be_judged) << report.table.claims[1].reason;
  EXPECT_GT(report.table.fits.front().exponent, 0.6);
  EXPECT_NEAR(number(report.table, 1, "penalty"), 0.1, 1e-15);
  EXPECT_NEAR(number(report.table, 1, "normal_rotation") / number(report.table, 0, "normal_rotation"), 0.1, 0.03);
}

TEST(Penalty, DoesNothingOnAFlatShell) {
  computation::Problem p = cantilever_plate();
  const Report report = penalty(p, {}, MPI_COMM_WORLD, {});
  EXPECT_EQ(report.table.rows.size(), 3U);
  EXPECT_NE(report.table.remarks.back().find("takes no part"), std::string::npos);
  expect_none_judged(report.table, "takes no part");
}

}  // namespace
}  // namespace plastron::study

// The comparison of figures, and docs/verification.md as made from them. PLASTRON_WRITE_DOCS=1 rewrites the page, and with
// PLASTRON_FIGURES=FILE figures.json before it: scripts/refresh-figures.
#include "verification/figures.hpp"

#include <gtest/gtest.h>
#include <generated_table.hpp>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace plastron::verification {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool held(const std::string& kind, const Figures& stored, const Figures& measured) {
  return objection(kind, stored, measured).empty();
}

TEST(AFigure, ThatIsAnErrorMayGrowThreefoldOnEitherSideOfZero) {
  for (const char* kind : {"error", "percent"})
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_TRUE(held(kind, -1e-4, sign * 2.9e-4));
      EXPECT_FALSE(held(kind, -1e-4, sign * 3.1e-4));
      EXPECT_TRUE(held(kind, 1e-4, 0));
    }
}

TEST(AFigure, BelowRoundingIsHeldToRounding) {
  EXPECT_TRUE(held("error", 1.5e-14, 9e-13));
  EXPECT_FALSE(held("error", 1.5e-14, 2e-12));
}

TEST(AFigure, OfLockingMayNotGetBetterUnnoticedEither) {
  EXPECT_TRUE(held("locking", -0.5, -0.54));
  EXPECT_FALSE(held("locking", -0.5, -0.56));
  EXPECT_FALSE(held("locking", -0.5, -0.44));
}

TEST(AFigure, OfADistanceIsGrantedATenthOfAnElement) {
  EXPECT_TRUE(held("elements", 0, 0.1));
  EXPECT_FALSE(held("elements", 0, 0.11));
  EXPECT_FALSE(held("elements", 0.5, 1.6));
  EXPECT_FALSE(held("elements", 0.5, std::numeric_limits<double>::infinity()));
}

TEST(AFigure, OfARateMayFallByATenth) {
  EXPECT_TRUE(held("rate", 2, 1.91));
  EXPECT_TRUE(held("rate", 2, 5));
  EXPECT_FALSE(held("rate", 2, 1.89));
}

TEST(AFigure, OfDigitsOrACountIsThatNumber) {
  EXPECT_TRUE(held("digits", -0.0248389, -0.02483894));
  EXPECT_FALSE(held("digits", -0.0248389, -0.0248392));
  EXPECT_TRUE(held("count", 25925, 25925));
  EXPECT_FALSE(held("count", 25925, 25926));
}

TEST(AFigure, OfAListIsHeldNumberByNumber) {
  EXPECT_TRUE(held("rate", {1, 2}, {1.2, 1.95}));
  EXPECT_FALSE(held("rate", {1, 2}, {1.2, 1.8}));
  EXPECT_FALSE(held("rate", {1, 2}, {1.2}));
  EXPECT_FALSE(held("rate", 1, Figures::array({1})));
}

TEST(AFigure, ThatIsNoNumberIsNeverHeld) {
  for (const char* kind : {"error", "percent", "locking", "elements", "rate", "digits", "count"}) {
    EXPECT_FALSE(held(kind, 1, nan)) << kind;
    EXPECT_FALSE(held(kind, nan, 1)) << kind;
    EXPECT_FALSE(held(kind, 1, nullptr)) << kind;
  }
}

Figures example() {
  return Figures::parse(R"({"table": {"program": "p", "rows are": "problem",
    "columns": {"energy": "error", "tip": "percent", "rates": "rate", "unknowns": "count"},
    "rows": {"first": {"energy": -9.9e-5, "tip": -0.137, "rates": [0.96, 2], "unknowns": 25925},
             "second": {"energy": 1.54e-14, "unknowns": 725}}}})");
}

TEST(Table, IsPrintedWithSignsShortExponentsAndDashesForWhatIsNotThere) {
  EXPECT_EQ(table_text(example()["table"]),
            "| problem | energy | tip | rates | unknowns |\n|---|---|---|---|---|\n"
            "| first | -9.9e-5 | -13.7 % | 0.96, 2.00 | 25 925 |\n"
            "| second | 1.5e-14 | - | - | 725 |\n");
}

TEST(Table, TakesWhatProgramsMeasured) {
  const Figures fresh = refreshed(example(),
                                  "[\"table\",\"second\",\"energy\",-2.46813e-7]\n"
                                  "[\"table\",\"third\",\"rates\",[1.23456,2.0]]\n");
  EXPECT_EQ(fresh["table"]["rows"]["second"]["energy"], -2.468e-7);
  EXPECT_EQ(fresh["table"]["rows"]["third"]["rates"], Figures({1.23, 2.0}));
  EXPECT_EQ(fresh["table"]["rows"]["first"], example()["table"]["rows"]["first"]);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(DocsVerification, HoldsTheTablesOfFiguresJson) {
  const bool writes = std::getenv("PLASTRON_WRITE_DOCS") != nullptr;
  Figures figures = Figures::parse(text_of(PLASTRON_FIGURES_FILE));
  if (const char* measured = std::getenv("PLASTRON_FIGURES"); writes && measured != nullptr) {
    figures = refreshed(figures, text_of(measured));
    std::ofstream(PLASTRON_FIGURES_FILE) << figures.dump(1) << "\n";
  }
  ASSERT_FALSE(figures.empty());
  const std::string page = text_of(PLASTRON_VERIFICATION_PAGE);
  std::string expected = page;
  for (const auto& [name, table] : figures.items()) expected = test::with_table(expected, name, table_text(table));
  if (writes) std::ofstream(PLASTRON_VERIFICATION_PAGE) << expected;
  EXPECT_EQ(text_of(PLASTRON_VERIFICATION_PAGE), expected) << "run scripts/refresh-figures --tables";
}

}  // namespace
}  // namespace plastron::verification

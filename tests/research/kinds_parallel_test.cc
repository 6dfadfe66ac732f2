// Studies on any number of ranks: the same numbers.
#include <gtest/gtest.h>
#include <research/study/kinds.hpp>

#include <cmath>

#include "computation/problems.hpp"
#include "research/tables.hpp"

namespace plastron::study {
namespace {

using namespace test;

constexpr double rounding = 1e-12;  // residuals and normal rotations are only rounding

void expect_same(const Report& together, const Report& alone) {
  ASSERT_EQ(together.status, contact::Status::solved);
  ASSERT_EQ(together.table.rows.size(), alone.table.rows.size());
  int numbers = 0;
  for (std::size_t r = 0; r < alone.table.rows.size(); ++r) {
    ASSERT_EQ(alone.table.rows[r].size(), alone.table.columns.size());
    for (std::size_t c = 0; c < alone.table.columns.size(); ++c) {
      const Entry &a = alone.table.rows[r][c], &b = together.table.rows[r][c];
      ASSERT_EQ(a.index(), b.index());
      if (alone.table.columns[c].unit == "s") continue;
      if (const auto* value = std::get_if<double>(&a)) {
        ++numbers;
        EXPECT_EQ(std::isnan(*value), std::isnan(std::get<double>(b)));
        if (std::isnan(*value)) continue;
        EXPECT_NEAR(std::get<double>(b), *value, 1e-6 * std::abs(*value) + rounding)
            << "row " << r << ", " << alone.table.columns[c].name;
      } else {
        EXPECT_EQ(a, b);
      }
    }
  }
  EXPECT_GT(numbers, 0);
  ASSERT_EQ(together.table.claims.size(), alone.table.claims.size());
  for (std::size_t i = 0; i < alone.table.claims.size(); ++i)
    EXPECT_EQ(together.table.claims[i].verdict, alone.table.claims[i].verdict) << alone.table.claims[i].statement;
}

TEST(Studies, find_the_same_on_any_number_of_ranks) {
  problem::Problem p = pressed_strip();
  p.discretisation.refinements = 1;
  const StudyOptions options = few_samples();
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    expect_same(kind.run(p, options, MPI_COMM_WORLD, {}), kind.run(p, options, MPI_COMM_SELF, {}));
  }
}

TEST(Studies, are_found_by_their_names) {
  for (const Kind& kind : kinds()) EXPECT_EQ(find_kind(kind.name), &kind);
  EXPECT_EQ(find_kind("no such study"), nullptr);
}

}  // namespace
}  // namespace plastron::study

// Live assertions stop the program and show values. Other builds do not evaluate them.
#include <plastron/algebra/assertion.hpp>

#include <gtest/gtest.h>

#include "algebra/assertions_are_live.hpp"
#include "algebra/chain.hpp"

namespace plastron::test {
namespace {

TEST(Assertion, is_evaluated_only_where_it_is_live) {
  int evaluated = 0;
  PLASTRON_ASSERT(++evaluated == 1, evaluated);
  EXPECT_EQ(evaluated, assertions_are_live ? 1 : 0);
}

TEST(Assertion, lists_values_of_every_kind) {
  EXPECT_EQ(algebra::listed(), "");
  EXPECT_EQ(algebra::listed(3, 2.5, "text"), "3, 2.5, text");
}

TEST(AssertionDeathTest, tells_the_condition_and_the_values) {
  if (cannot_watch_a_program_die()) GTEST_SKIP() << "assertions are off, or several ranks";
  const int rows = 3, columns = 4;
  EXPECT_DEATH(PLASTRON_ASSERT(rows == columns, rows, columns),
               "assertion_test.cc:.*rows == columns; rows, columns = 3, 4");
  EXPECT_DEATH(PLASTRON_ASSERT(rows > columns), "assertion failed: rows > columns\n");
}

TEST(AssertionDeathTest, keeps_vectors_of_different_blocks_apart) {
  if (cannot_watch_a_program_die()) GTEST_SKIP() << "assertions are off, or several ranks";
  const auto two = layout_for(6, {}), three = layout_for(4, {});
  const Vector a(two, 2);
  Vector b(three, 3);
  EXPECT_DEATH(algebra::dot(a, b), "a.block\\(\\).* = 2, 3, 12, 12");
  EXPECT_DEATH(algebra::axpy(1, a, b), "2, 3, 12, 12");
}

TEST(AssertionDeathTest, wants_ghosts_in_ascending_order_from_other_ranks) {
  if (cannot_watch_a_program_die()) GTEST_SKIP() << "assertions are off, or several ranks";
  const auto plan = [](std::vector<GlobalIndex> ghosts) {
    Layout(Distribution{.owned = 2, .global_size = 5, .ghosts = std::move(ghosts)});
  };
  for (const auto& ghosts : {std::vector<GlobalIndex>{4, 3}, {3, 3}, {1, 3}, {3, 5}})
    EXPECT_DEATH(plan(ghosts), "ghosts_are_ascending_and_others");
}

}  // namespace
}  // namespace plastron::test

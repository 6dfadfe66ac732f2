// The parts of a problem fit together, or the sanitizer build stops.
#include <gtest/gtest.h>
#include <plastron/algebra/factorisation.hpp>

#include "algebra/assertions_are_live.hpp"
#include "contact/dense_problem.hpp"

namespace plastron::test {
namespace {

TEST(BoxProblemDeathTest, whose_bounds_have_another_size_than_its_load_stops_the_solver) {
  if (cannot_watch_a_program_die()) GTEST_SKIP() << "assertions are off, or several ranks";
  const DistributedProblem problem(random_problem(5, 1));
  algebra::Factorisation F(problem.matrix);
  contact::BoxProblem longer = *problem.box, wider = *problem.box;
  longer.lower = longer.upper = Vector(layout_for(7, {}), 1);
  wider.lower = wider.upper = Vector(problem.matrix.layout(), 2);
  EXPECT_DEATH(contact::solve_primal_dual_active_set(longer, {}, F), "lower.owned\\(\\).size\\(\\).* = 5, 7, 7");
  EXPECT_DEATH(contact::solve_projected_search(wider, {}, F), "lower.block\\(\\).* = 1, 1, 2, 2");
}

}  // namespace
}  // namespace plastron::test

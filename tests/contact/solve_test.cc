// The solver that the settings name, and what it is given.
#include <gtest/gtest.h>

#include "contact/dense_problem.hpp"

namespace plastron::test {

std::vector<NamedSolver> solvers() {
  return {{"active-set", contact::solve_primal_dual_active_set}, {"projected", contact::solve_projected_search}};
}

namespace {

TEST(Solve, TakesTheSolverOfTheSettingsAndTheActiveSetByDefault) {
  const DistributedProblem problem(random_problem(20, 7));
  algebra::Factorisation F(problem.matrix);
  for (const NamedSolver& solver : solvers()) {
    const auto direct = solve_with(solver, *problem.box, F);
    const auto by_settings = contact::solve(*problem.box, {}, F, {.solver = solver.solve});
    EXPECT_EQ(gathered(direct.z), gathered(by_settings.z)) << solver.name;
    EXPECT_EQ(direct.iterations.size(), by_settings.iterations.size()) << solver.name;
  }
  EXPECT_EQ(&contact::solver_of({}), &contact::solve_primal_dual_active_set);
}

TEST(InitialActiveSet, OfAWrongSizeOnOneRankIsRefusedOnAll) {
  const DistributedProblem problem(random_problem(6, 1));
  algebra::Factorisation F(problem.matrix);
  std::vector<contact::Activity> initial(problem.box->load.owned().size(), contact::Activity::free);
  if (rank() == ranks() - 1) initial.push_back(contact::Activity::free);
  EXPECT_THROW(contact::solve_primal_dual_active_set(*problem.box, initial, F), std::invalid_argument);
}

/// With finite rotations the caller shifts the matrix then. All bounds together would hide the motion.
TEST(AnExpectedSetThatLeavesAnIndefiniteMatrix, EndsTheSolutionAfterOneFactorisation) {
  for (const int seed : {1, 2, 3}) {
    DenseProblem dense = random_problem(12, seed);
    dense.A.row(0).setZero(), dense.A.col(0).setZero();
    dense.A(0, 0) = -1;
    dense.lower.setConstant(-1), dense.upper.setConstant(infinity);
    DistributedProblem problem(dense);
    problem.box->may_be_indefinite = true;
    algebra::Factorisation F(problem.matrix);
    std::vector<contact::Activity> expected;
    for (LocalIndex i = 0; i < problem.matrix.layout()->owned; ++i)
      expected.push_back(problem.matrix.layout()->global(i) == 5 ? contact::Activity::at_lower
                                                                 : contact::Activity::free);
    const auto solution = contact::solve(*problem.box, expected, F);
    EXPECT_EQ(solution.status, contact::Status::singular);
    EXPECT_TRUE(solution.iterations.empty());
    EXPECT_EQ(F.factorisations(), 1);
  }
}

}  // namespace
}  // namespace plastron::test

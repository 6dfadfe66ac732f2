#include <gtest/gtest.h>

#include "contact/expect_solution.hpp"

namespace plastron::test {
namespace {

using contact::Activity;

TEST(EverySolver, agrees_with_brute_force_over_all_active_sets) {
  const unsigned problems = ranks() == 1 ? 300 : 7;  // MUMPS is slow on tiny systems
  for (unsigned seed = 1; seed <= problems; ++seed) {
    const Eigen::Index n = 1 + seed % 7;
    const DenseProblem dense = random_problem(n, seed);
    const auto exact = brute_force(dense);
    ASSERT_TRUE(exact);
    const DistributedProblem problem(dense);
    algebra::Factorisation F(problem.matrix);
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const NamedSolver& solver : solvers()) {
      SCOPED_TRACE(solver.name);
      expect_solution(*problem.box, solve_with(solver, *problem.box, F), *exact);
    }
  }
}

TEST(EverySolver, finds_the_same_solution_from_any_active_set) {
  const Eigen::Index n = 8;
  const DenseProblem dense = random_problem(n, 2026);
  const auto exact = brute_force(dense);
  ASSERT_TRUE(exact);
  const DistributedProblem problem(dense);
  algebra::Factorisation F(problem.matrix);
  for (unsigned start = 0; start < 6; ++start) {
    std::vector<Activity> initial(problem.box->load.owned().size());
    for (std::size_t i = 0; i < initial.size(); ++i) {
      const auto k = static_cast<unsigned>(problem.box->load.layout()->first) + static_cast<unsigned>(i);
      initial[i] = static_cast<Activity>((start * 7 + k * k) % 3);
    }
    for (const NamedSolver& solver : solvers()) {
      SCOPED_TRACE(solver.name + " from start " + std::to_string(start));
      expect_solution(*problem.box, solve_with(solver, *problem.box, F, initial), *exact);
    }
  }
}

TEST(EverySolver, fulfils_the_optimality_conditions_on_larger_problems) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const DenseProblem dense = random_problem(60, seed);
    const DistributedProblem problem(dense);
    algebra::Factorisation F(problem.matrix);
    const auto plain = contact::solve_primal_dual_active_set(*problem.box, {}, F);
    const Eigen::VectorXd z = gathered(plain.z);
    expect_solution(*problem.box, plain, z);
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      EXPECT_GE(z(i), dense.lower(i) - 1e-10 * z.cwiseAbs().maxCoeff());
      EXPECT_LE(z(i), dense.upper(i) + 1e-10 * z.cwiseAbs().maxCoeff());
    }
    EXPECT_LT((gathered(plain.multiplier) - (dense.A * z - dense.b)).cwiseAbs().maxCoeff(), 1e-10);
    for (const NamedSolver& solver : solvers()) {
      SCOPED_TRACE(solver.name);
      expect_solution(*problem.box, solve_with(solver, *problem.box, F), z);
    }
  }
}

}  // namespace
}  // namespace plastron::test

#include <gtest/gtest.h>

#include "contact/dense_problem.hpp"

namespace plastron::test {
namespace {

using contact::Activity;
using contact::BoxProblem;
using contact::BoxSolution;
using contact::Status;

void expect_solution(const BoxProblem& problem, const BoxSolution& solution, const Eigen::VectorXd& exact) {
  ASSERT_EQ(solution.status, Status::solved);
  EXPECT_LT((gathered(solution.z) - exact).cwiseAbs().maxCoeff(), 1e-9 * (1 + exact.cwiseAbs().maxCoeff()));
  const double slack = 1e-9 * (1 + algebra::max_abs(solution.multiplier));
  for (std::size_t i = 0; i < solution.activity.size(); ++i) {
    const double z = solution.z.owned()[i];
    const double multiplier = solution.multiplier.owned()[i];
    switch (solution.activity[i]) {
      case Activity::free:
        EXPECT_NEAR(multiplier, 0, slack);
        break;
      case Activity::at_lower:
        EXPECT_EQ(z, problem.lower.owned()[i]);
        EXPECT_GE(multiplier, -slack);
        break;
      case Activity::at_upper:
        EXPECT_EQ(z, problem.upper.owned()[i]);
        EXPECT_LE(multiplier, slack);
        break;
      case Activity::prescribed:
        EXPECT_EQ(z, problem.lower.owned()[i]);
        break;
    }
  }
}

TEST(EverySolver, agrees_with_brute_force_over_all_active_sets) {
  const unsigned problems = ranks() == 1 ? 300 : 14;  // MUMPS takes its time on tiny systems
  for (unsigned seed = 1; seed <= problems; ++seed) {
    const Eigen::Index n = 1 + seed % 7;
    const DenseProblem dense = random_problem(n, seed);
    const auto exact = brute_force(dense);
    ASSERT_TRUE(exact);
    const DistributedProblem problem(dense);
    algebra::Factorisation F(problem.matrix);
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_solution(*problem.box, contact::solve_primal_dual_active_set(*problem.box, {}, F), *exact);
    expect_solution(*problem.box, contact::solve_projected_search(*problem.box, {}, F), *exact);
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
    expect_solution(*problem.box, contact::solve_primal_dual_active_set(*problem.box, initial, F), *exact);
    expect_solution(*problem.box, contact::solve_projected_search(*problem.box, initial, F), *exact);
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
    expect_solution(*problem.box, contact::solve_projected_search(*problem.box, {}, F), z);
  }
}

}  // namespace
}  // namespace plastron::test

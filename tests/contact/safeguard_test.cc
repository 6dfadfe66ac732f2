#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "contact/dense_problem.hpp"

namespace plastron::test {
namespace {

using contact::Status;

// Two problems z >= 0 on which the primal-dual method, started from an empty active set, returns to an earlier set.
// They come from a search over random integer matrices. Three million matrices with three unknowns gave none.
DenseProblem four_unknowns() {
  DenseProblem problem{.A = Eigen::MatrixXd{{23, 6, -18, -16}, {6, 14, -1, -10}, {-18, -1, 19, 12}, {-16, -10, 12, 17}},
                       .b = Eigen::VectorXd{{-7, 7, 8, -4}},
                       .lower = Eigen::VectorXd::Zero(4),
                       .upper = Eigen::VectorXd::Constant(4, infinity)};
  return problem;
}

DenseProblem five_unknowns() {
  DenseProblem problem{.A = Eigen::MatrixXd{{20, 10, -13, -21, 9},
                                            {10, 33, 7, -13, -5},
                                            {-13, 7, 19, 13, -11},
                                            {-21, -13, 13, 25, -12},
                                            {9, -5, -11, -12, 25}},
                       .b = Eigen::VectorXd{{-4, 9, 7, -3, -7}},
                       .lower = Eigen::VectorXd::Zero(5),
                       .upper = Eigen::VectorXd::Constant(5, infinity)};
  return problem;
}

bool plain_method_cycles(const DenseProblem& problem) {
  std::vector<int> side(static_cast<std::size_t>(problem.size()), 0);
  std::set<std::vector<int>> seen;
  while (seen.insert(side).second) {
    const Eigen::VectorXd z = minimise_on_face(problem, side);
    if (is_optimal(problem, side, z)) return false;
    const Eigen::VectorXd multiplier = problem.A * z - problem.b;
    for (std::size_t i = 0; i < side.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      side[i] = side[i] ? multiplier(k) >= 0 : z(k) < problem.lower(k);
    }
  }
  return true;
}

TEST(PrimalDualActiveSet, hands_over_to_the_projected_search_where_it_would_cycle) {
  for (const DenseProblem& dense : {four_unknowns(), five_unknowns()}) {
    ASSERT_TRUE(plain_method_cycles(dense));
    const DistributedProblem problem(dense);
    algebra::Factorisation F(problem.matrix);
    const auto solution = contact::solve_primal_dual_active_set(*problem.box, {}, F);
    ASSERT_EQ(solution.status, Status::solved);
    EXPECT_TRUE(solution.iterations.back().safeguarded);
    EXPECT_FALSE(solution.iterations.front().safeguarded);
    EXPECT_LT((gathered(solution.z) - *brute_force(dense)).cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(ProjectedSearch, lowers_the_energy_at_every_step) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const DistributedProblem problem(random_problem(30, seed));
    algebra::Factorisation F(problem.matrix);
    const auto solution = contact::solve_projected_search(*problem.box, {}, F);
    ASSERT_EQ(solution.status, Status::solved);
    const double rounding = 1e-10 * std::abs(solution.iterations.back().energy);
    for (std::size_t k = 1; k < solution.iterations.size(); ++k)
      EXPECT_LE(solution.iterations[k].energy, solution.iterations[k - 1].energy + rounding);
  }
}

}  // namespace
}  // namespace plastron::test

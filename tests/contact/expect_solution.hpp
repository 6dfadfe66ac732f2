// Expects that a solution is the exact one, with the right activity and multipliers.
#pragma once
#include <gtest/gtest.h>

#include "contact/dense_problem.hpp"

namespace plastron::test {

inline void expect_solution(const contact::BoxProblem& problem, const contact::BoxSolution& solution,
                            const Eigen::VectorXd& exact) {
  ASSERT_EQ(solution.status, contact::Status::solved);
  EXPECT_LT((gathered(solution.z) - exact).cwiseAbs().maxCoeff(), 1e-9 * (1 + exact.cwiseAbs().maxCoeff()));
  const double slack = 1e-9 * (1 + algebra::max_abs(solution.multiplier));
  for (std::size_t i = 0; i < solution.activity.size(); ++i) {
    const double z = solution.z.owned()[i];
    const double multiplier = solution.multiplier.owned()[i];
    switch (solution.activity[i]) {
      case contact::Activity::free:
        EXPECT_NEAR(multiplier, 0, slack);
        break;
      case contact::Activity::at_lower:
        EXPECT_EQ(z, problem.lower.owned()[i]);
        EXPECT_GE(multiplier, -slack);
        break;
      case contact::Activity::at_upper:
        EXPECT_EQ(z, problem.upper.owned()[i]);
        EXPECT_LE(multiplier, slack);
        break;
      case contact::Activity::prescribed:
        EXPECT_EQ(z, problem.lower.owned()[i]);
        break;
    }
  }
}

}  // namespace plastron::test

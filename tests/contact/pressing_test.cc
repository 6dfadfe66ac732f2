// Bounds that given forces move: every solver against brute force, in any units, and what force and position are to each other.
#include <plastron/contact/pressing.hpp>

#include <gtest/gtest.h>

#include <algorithm>

#include "contact/pressed_problem.hpp"

namespace plastron::test {
namespace {

using contact::Solver;
using contact::Status;

unsigned some_problems(unsigned on_one_rank) { return ranks() == 1 ? on_one_rank : 3; }

void expect_pressed_solution(const PressedDense& dense, const contact::BoxProblem& problem,
                             const contact::BoxSolution& solution, const PressedSolution& exact) {
  ASSERT_EQ(solution.status, Status::solved);
  const Eigen::VectorXd z = gathered(solution.z), positions = positions_of(solution);
  const double size = 1 + exact.z.cwiseAbs().maxCoeff() + exact.positions.cwiseAbs().maxCoeff();
  EXPECT_LT((z - exact.z).cwiseAbs().maxCoeff(), 1e-8 * size);
  EXPECT_LT((positions - exact.positions).cwiseAbs().maxCoeff(), 1e-8 * size);
  EXPECT_NEAR(energy_of(dense, z, positions), exact.energy, 1e-8 * (1 + std::abs(exact.energy)));
  EXPECT_NEAR(solution.iterations.back().energy, exact.energy, 1e-8 * (1 + std::abs(exact.energy)));
  const auto answers = contact::reactions(problem, solution.multiplier, solution.activity);
  for (Eigen::Index k = 0; k < dense.force.size(); ++k)
    EXPECT_NEAR(answers[static_cast<std::size_t>(k)], dense.force(k), 1e-10 * dense.force(k));
}

void expect_that_all_press(const PressedDense& dense, const PressedSolution& exact) {
  const DistributedPressed pressed(dense);
  algebra::Factorisation F(pressed.matrix());
  for (const Solver solver : contact::all_solvers) {
    SCOPED_TRACE(name_of(solver));
    expect_pressed_solution(dense, pressed.problem(), solve_with(solver, pressed.problem(), F), exact);
  }
}

TEST(EverySolver, finds_what_forces_press_as_brute_force_does) {
  const unsigned problems = some_problems(150);
  for (const Eigen::Index forces : {1, 2}) {
    unsigned solvable = 0;
    for (unsigned seed = 1; seed <= problems; ++seed) {
      const Eigen::Index n = 3 + seed % 5;
      SCOPED_TRACE("seed " + std::to_string(seed) + ", forces " + std::to_string(forces));
      const PressedDense dense = random_pressed(n, forces, seed);
      const auto exact = brute_force(dense);
      solvable += exact.has_value();
      if (exact) {
        expect_that_all_press(dense, *exact);
        continue;
      }
      const DistributedPressed pressed(dense);
      algebra::Factorisation F(pressed.matrix());
      for (const Solver solver : contact::all_solvers) {
        const Status status = solve_with(solver, pressed.problem(), F).status;
        EXPECT_NE(status, Status::solved) << name_of(solver);
        printf("seed %u forces %d n %d %s: %s\n", seed, int(forces), int(n), name_of(solver).c_str(), contact::to_string(status).data());
      }
    }
    printf("%u of %u\n", solvable, problems);
    EXPECT_GE(solvable, problems / 3);
  }
}

}  // namespace
}  // namespace plastron::test

// Bounds that given forces move: every solver against brute force over all active sets with their borders, in any units, with ties, supported by
// bounds alone, and with equations.
#include <plastron/contact/pressing.hpp>

#include <gtest/gtest.h>

#include "contact/pressed_problem.hpp"

namespace plastron::test {
namespace {

using contact::Status;

unsigned some_problems(unsigned on_one_rank) {
  return ranks() == 1 ? on_one_rank : 2;
}  // MUMPS is slow on tiny systems

void expect_pressed_solution(const PressedDense& dense, const contact::BoxProblem& problem,
                             const contact::BoxSolution& solution, const PressedSolution& exact) {
  ASSERT_EQ(solution.status, Status::solved) << contact::to_string(solution.status);
  const Eigen::VectorXd z = gathered(solution.z), positions = positions_of(solution);
  const double size = exact.z.cwiseAbs().maxCoeff() + exact.positions.cwiseAbs().maxCoeff();
  EXPECT_LT((z - exact.z).cwiseAbs().maxCoeff(), 1e-8 * size);
  EXPECT_LT((positions - exact.positions).cwiseAbs().maxCoeff(), 1e-8 * size);
  const double energy = std::abs(exact.energy) + dense.force.cwiseAbs().dot(exact.positions.cwiseAbs());
  EXPECT_NEAR(energy_of(dense, z, positions), exact.energy, 1e-8 * energy);
  EXPECT_NEAR(solution.iterations.back().energy, exact.energy, 1e-8 * energy);
  const auto answers = contact::reactions(problem, solution.multiplier, solution.activity);
  for (Eigen::Index k = 0; k < dense.force.size(); ++k)
    EXPECT_NEAR(answers[static_cast<std::size_t>(k)], dense.force(k), 1e-10 * dense.force(k));
}

void expect_that_all_press(const PressedDense& dense, const PressedSolution& exact) {
  const DistributedPressed pressed(dense);
  algebra::Factorisation F(pressed.matrix());
  for (const NamedSolver& solver : solvers()) {
    SCOPED_TRACE(solver.name);
    expect_pressed_solution(dense, pressed.problem(), solve_with(solver, pressed.problem(), F), exact);
  }
}

/// No subproblem has the solution: bounds press on each other, or nothing stops a force. All solvers must report the same.
void expect_that_none_presses(const PressedDense& dense) {
  const DistributedPressed pressed(dense);
  algebra::Factorisation F(pressed.matrix());
  const Status status = contact::solve_primal_dual_active_set(pressed.problem(), {}, F).status;
  EXPECT_TRUE(status == Status::infeasible || status == Status::not_carried) << contact::to_string(status);
  for (const NamedSolver& solver : solvers())
    EXPECT_EQ(solve_with(solver, pressed.problem(), F).status, status) << solver.name;
}

TEST(EverySolver, finds_what_forces_press_as_brute_force_does) {
  const unsigned problems = some_problems(150);
  for (const Eigen::Index forces : {1, 2}) {
    unsigned solvable = 0;
    for (unsigned seed = 1; seed <= problems; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", forces " + std::to_string(forces));
      const PressedDense dense = random_pressed(3 + seed % 5, forces, seed);
      const auto exact = brute_force(dense);
      solvable += exact.has_value();
      if (exact)
        expect_that_all_press(dense, *exact);
      else
        expect_that_none_presses(dense);
    }
    EXPECT_GE(solvable, 2 * problems / 3);
  }
}

// z and delta are chosen first. Every unknown with bounds is at one; every other one of these has no multiplier. Forces and load follow.
TEST(EverySolver, presses_with_bounds_that_carry_no_force) {
  unsigned tested = 0;
  for (unsigned seed = 1; seed <= some_problems(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    PressedDense dense = random_pressed(4 + seed % 4, 1 + seed % 2, seed);
    const Eigen::Index n = dense.box.size();
    const PressedDense drawn = dense;
    PressedSolution exact{.z = Eigen::VectorXd::LinSpaced(n, -1, 1),
                          .positions = Eigen::VectorXd::LinSpaced(dense.force.size(), 0.7, 1.9)};
    Eigen::VectorXd multiplier = Eigen::VectorXd::Zero(n);
    dense.force.setZero();
    for (Eigen::Index i = 0; i < n; ++i) {
      const bool below = std::isfinite(drawn.box.lower(i)), above = std::isfinite(drawn.box.upper(i));
      if (below) dense.box.lower(i) = exact.z(i) - dense.lower_shape.row(i) * exact.positions;
      if (below && above) dense.box.upper(i) = drawn.box.lower(i) == drawn.box.upper(i) ? dense.box.lower(i) : no_bound;
      if (above && !below) dense.box.upper(i) = exact.z(i) - dense.upper_shape.row(i) * exact.positions;
      if ((below || above) && (i % 2 == 0 || i < dense.force.size())) multiplier(i) = below ? 1 : -1;
      dense.force += multiplier(i) * (below ? dense.lower_shape : dense.upper_shape).row(i).transpose();
    }
    if (dense.force.minCoeff() <= 0.1) continue;
    ++tested;
    dense.box.b = dense.box.A * exact.z - multiplier;
    exact.energy = energy_of(dense, exact.z, exact.positions);
    expect_that_all_press(dense, exact);
  }
  EXPECT_GE(tested, 1 + some_problems(60) / 3);
}

TEST(EverySolver, does_not_mind_the_units_of_what_forces_press) {
  for (unsigned seed = 1; seed <= some_problems(40); ++seed) {
    for (const double unit : {1e-6, 1e6}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", unit " + std::to_string(unit));
      PressedDense dense = random_pressed(3 + seed % 5, 1 + seed % 2, seed);
      auto exact = brute_force(dense);
      if (!exact) continue;
      const double newton = seed % 3 == 0 ? 1e6 : 1.0;
      dense.box = {.A = newton / unit * dense.box.A,
                   .b = newton * dense.box.b,
                   .lower = unit * dense.box.lower,
                   .upper = unit * dense.box.upper};
      dense.force *= newton;
      *exact = {.z = unit * exact->z, .positions = unit * exact->positions, .energy = newton * unit * exact->energy};
      expect_that_all_press(dense, *exact);
    }
  }
}

// An unsupported chain lies with one half on a table, and punches press on the other half. Its load alone does not turn it over.
TEST(EverySolver, presses_what_only_bounds_hold) {
  unsigned solvable = 0;
  for (unsigned seed = 1; seed <= some_problems(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Eigen::Index n = 4 + seed % 4;
    PressedDense dense = random_pressed(n, 1, seed);
    dense.box.A.setZero();
    for (Eigen::Index i = 0; i + 1 < n; ++i) dense.box.A.block(i, i, 2, 2) += Eigen::Matrix2d{{3, -3}, {-3, 3}};
    dense.box.b *= 0.1;
    for (Eigen::Index i = 0; i < n; ++i) {
      dense.box.lower(i) = i < n / 2 ? -0.1 * static_cast<double>(i) : -no_bound;
      dense.box.upper(i) = i < n / 2 ? no_bound : 0.3 * static_cast<double>(i % 2);
      dense.lower_shape(i, 0) = 0;
      dense.upper_shape(i, 0) = i < n / 2 ? 0 : -1;
    }
    const auto exact = brute_force(dense);
    if (!exact) continue;
    ++solvable;
    expect_that_all_press(dense, *exact);
  }
  EXPECT_GE(solvable, some_problems(60) / 2);
}

}  // namespace
}  // namespace plastron::test

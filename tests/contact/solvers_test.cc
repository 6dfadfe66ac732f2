// All solvers against brute force where it is hard: ties, units, structures that only bounds hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "contact/expect_solution.hpp"

namespace plastron::test {
namespace {

using contact::Status;

unsigned problems(unsigned on_one_rank) { return ranks() == 1 ? on_one_rank : 3; }  // MUMPS is slow on tiny systems

void expect_that_all_find(const DenseProblem& dense, const Eigen::VectorXd& exact) {
  const DistributedProblem problem(dense);
  algebra::Factorisation F(problem.matrix);
  for (const NamedSolver& solver : solvers()) {
    SCOPED_TRACE(solver.name);
    expect_solution(*problem.box, solve_with(solver, *problem.box, F), exact);
  }
}

/// The solution is chosen first. Every unknown with a bound is at it; every other one of these has no multiplier.
std::pair<DenseProblem, Eigen::VectorXd> with_ties(Eigen::Index n, unsigned seed) {
  DenseProblem problem = random_problem(n, seed);
  Eigen::VectorXd z = Eigen::VectorXd::LinSpaced(n, -1, 1), multiplier = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool has_lower = std::isfinite(problem.lower(i)), has_upper = std::isfinite(problem.upper(i));
    if (has_lower || has_upper) z(i) = has_lower ? problem.lower(i) : problem.upper(i);
    if ((has_lower || has_upper) && i % 2 == 0) multiplier(i) = has_lower ? 1 : -1;
  }
  problem.b = problem.A * z - multiplier;
  return {problem, z};
}

TEST(EverySolver, finds_solutions_with_bounds_that_carry_no_force) {
  for (unsigned seed = 1; seed <= problems(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto [dense, z] = with_ties(2 + seed % 6, seed);
    const auto exact = brute_force(dense);
    ASSERT_TRUE(exact);
    ASSERT_LT((*exact - z).cwiseAbs().maxCoeff(), 1e-9);
    expect_that_all_find(dense, z);
  }
}

// The same solution in other units: unknowns with bounds in 1e-6 or 1e6, all others in several units at once. Tolerances of gaps are
// multiples of the largest unknown with a bound, so these share one unit, as displacements do.
Eigen::VectorXd units_of(const DenseProblem& dense, unsigned seed) {
  Eigen::VectorXd unit(dense.size());
  for (Eigen::Index i = 0; i < unit.size(); ++i) {
    const bool is_bounded =
        dense.lower(i) < dense.upper(i) && (std::isfinite(dense.lower(i)) || std::isfinite(dense.upper(i)));
    unit(i) = is_bounded ? (seed % 2 ? 1e-6 : 1e6) : std::array{1e-6, 1.0, 1e6}[static_cast<std::size_t>(i % 3)];
  }
  return unit;
}

TEST(EverySolver, does_not_mind_units) {
  for (unsigned seed = 1; seed <= problems(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const DenseProblem dense = random_problem(2 + seed % 6, seed);
    const auto exact = brute_force(dense);
    ASSERT_TRUE(exact);
    const Eigen::VectorXd unit = units_of(dense, seed);
    const Eigen::VectorXd inverse = unit.cwiseInverse();
    const DistributedProblem problem({.A = inverse.asDiagonal() * dense.A * inverse.asDiagonal(),
                                      .b = inverse.cwiseProduct(dense.b),
                                      .lower = unit.cwiseProduct(dense.lower),
                                      .upper = unit.cwiseProduct(dense.upper)});
    algebra::Factorisation F(problem.matrix);
    for (const NamedSolver& solver : solvers()) {
      const auto solution = solve_with(solver, *problem.box, F);
      ASSERT_EQ(solution.status, Status::solved) << solver.name;
      EXPECT_LT((inverse.cwiseProduct(gathered(solution.z)) - *exact).cwiseAbs().maxCoeff(),
                1e-8 * (1 + exact->cwiseAbs().maxCoeff()))
          << solver.name;
    }
  }
}

// A row of springs that only bounds hold, below and above. The load presses the whole row down.
DenseProblem held_by_bounds_alone(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  DenseProblem problem{.A = Eigen::MatrixXd::Zero(n, n),
                       .b = Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); }),
                       .lower = Eigen::VectorXd::NullaryExpr(n, [&] { return -std::abs(normal(random)); }),
                       .upper = Eigen::VectorXd::Constant(n, infinity)};
  for (Eigen::Index i = 0; i + 1 < n; ++i) problem.A.block(i, i, 2, 2) += Eigen::Matrix2d{{3.0, -3.0}, {-3.0, 3.0}};
  problem.b.array() -= problem.b.mean() + 0.5;
  for (Eigen::Index i = 0; i < n; ++i)
    if (i % 3 == 1) problem.upper(i) = problem.lower(i) + 0.2;
  return problem;
}

TEST(EverySolver, solves_what_only_bounds_hold) {
  for (unsigned seed = 1; seed <= problems(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const DenseProblem dense = held_by_bounds_alone(2 + seed % 6, seed);
    const auto exact = brute_force(dense);
    ASSERT_TRUE(exact);
    expect_that_all_find(dense, *exact);
  }
}

TEST(EverySolver, presses_against_the_bound_that_the_load_points_to) {
  for (const double load : {-2.0, -0.5, 0.5, 2.0}) {
    const DenseProblem dense{.A = Eigen::MatrixXd{{2, 0}, {0, 2}},
                             .b = Eigen::VectorXd{{load, -load}},
                             .lower = Eigen::VectorXd::Constant(2, -0.5),
                             .upper = Eigen::VectorXd::Constant(2, 0.5)};
    const DistributedProblem problem(dense);
    algebra::Factorisation F(problem.matrix);
    const double z = std::clamp(load / 2, -0.5, 0.5);
    for (const NamedSolver& solver : solvers()) {
      const auto solution = solve_with(solver, *problem.box, F);
      EXPECT_NEAR(gathered(solution.z)(0), z, 1e-12) << solver.name;
      EXPECT_NEAR(gathered(solution.z)(1), -z, 1e-12) << solver.name;
      EXPECT_NEAR(gathered(solution.multiplier)(0), 2 * z - load, 1e-12) << solver.name;
      EXPECT_NEAR(gathered(solution.multiplier)(1), load - 2 * z, 1e-12) << solver.name;
    }
  }
}

// The unknown at its bound feels no force: whether it counts as active must not matter, nor set the solvers cycling.
TEST(EverySolver, takes_a_degenerate_problem_from_either_side) {
  DenseProblem dense{.A = Eigen::MatrixXd{{2, -1, 0}, {-1, 2, -1}, {0, -1, 2}},
                     .b = Eigen::VectorXd{{-1, 2, -1}},
                     .lower = Eigen::VectorXd::Zero(3),
                     .upper = Eigen::VectorXd::Constant(3, infinity)};
  const DistributedProblem problem(dense);
  algebra::Factorisation F(problem.matrix);
  for (const auto activity : {contact::Activity::free, contact::Activity::at_lower}) {
    const std::vector<contact::Activity> initial(problem.box->load.owned().size(), activity);
    for (const NamedSolver& solver : solvers()) {
      const auto solution = solve_with(solver, *problem.box, F, initial);
      EXPECT_EQ(solution.status, Status::solved) << solver.name;
      EXPECT_LT((gathered(solution.z) - Eigen::Vector3d(0, 1, 0)).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace plastron::test

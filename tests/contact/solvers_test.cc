// All solvers against brute force where it is hard: ties, units, structures that only bounds hold; and the dispatcher.
#include <plastron/contact/mprgp.hpp>
#include <plastron/contact/snesvi.hpp>
#include <plastron/contact/tao.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "contact/expect_solution.hpp"
#include "contact/jacobi.hpp"

namespace plastron::test {
namespace {

using contact::Solver;
using contact::Status;

unsigned problems(unsigned on_one_rank) {
  return ranks() == 1 ? on_one_rank : 3;
}  // MUMPS takes its time on tiny systems

void expect_that_all_find(const DenseProblem& dense, const Eigen::VectorXd& exact) {
  const DistributedProblem problem(dense);
  algebra::Factorisation F(problem.matrix);
  for (const Solver solver : contact::all_solvers) {
    SCOPED_TRACE(name_of(solver));
    expect_solution(*problem.box, solve_with(solver, *problem.box, F), exact);
  }
}

/// The solution is chosen first: every unknown with a bound is at it, every other one of these without a force.
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

// What has bounds in units of 1e-6 or of 1e6, anything else in several at once: the solution in other words. Tolerances of gaps are
// multiples of the largest unknown that has a bound, so these share one unit, as displacements do.
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
    for (const Solver solver : contact::all_solvers) {
      const auto solution = solve_with(solver, *problem.box, F);
      ASSERT_EQ(solution.status, Status::solved) << name_of(solver);
      EXPECT_LT((inverse.cwiseProduct(gathered(solution.z)) - *exact).cwiseAbs().maxCoeff(),
                1e-8 * (1 + exact->cwiseAbs().maxCoeff()))
          << name_of(solver);
    }
  }
}

// Springs in a row that nothing holds but bounds below and above; the load presses the whole down.
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
    for (const Solver solver : contact::all_solvers) {
      const auto solution = solve_with(solver, *problem.box, F);
      EXPECT_NEAR(gathered(solution.z)(0), z, 1e-12) << name_of(solver);
      EXPECT_NEAR(gathered(solution.z)(1), -z, 1e-12) << name_of(solver);
      EXPECT_NEAR(gathered(solution.multiplier)(0), 2 * z - load, 1e-12) << name_of(solver);
      EXPECT_NEAR(gathered(solution.multiplier)(1), load - 2 * z, 1e-12) << name_of(solver);
    }
  }
}

TEST(EverySolver, needs_no_factor) {
  for (unsigned seed = 1; seed <= problems(30); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const DenseProblem dense = random_problem(1 + seed % 7, seed);
    const auto exact = brute_force(dense);
    const DistributedProblem problem(dense);
    Jacobi D(problem.matrix);
    for (const Solver solver : contact::all_solvers) {
      SCOPED_TRACE(name_of(solver));
      expect_solution(*problem.box, solve_with(solver, *problem.box, D), *exact);
    }
  }
}

TEST(Mprgp, sets_its_preconditioner_up_once) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const DistributedProblem problem(random_problem(40, seed));
    Jacobi D(problem.matrix);
    algebra::Factorisation F(problem.matrix);
    const auto solution = contact::solve_mprgp(*problem.box, {}, F);
    EXPECT_EQ(solution.status, Status::solved);
    EXPECT_EQ(F.factorisations(), 1);
    EXPECT_EQ(contact::solve_mprgp(*problem.box, {}, D).status, Status::solved);
    EXPECT_EQ(D.pinnings, 1);
    EXPECT_GT(solution.iterations.size(), 1U);
  }
}

TEST(Mprgp, lowers_the_energy_at_every_step) {
  for (unsigned seed = 1; seed <= problems(10); ++seed) {
    const DistributedProblem problem(random_problem(30, seed));
    algebra::Factorisation F(problem.matrix);
    const auto solution = contact::solve_mprgp(*problem.box, {}, F);
    ASSERT_EQ(solution.status, Status::solved);
    const double rounding = 1e-10 * std::abs(solution.iterations.back().energy);
    double last = infinity;
    for (const contact::Iteration& iteration : solution.iterations) {
      if (iteration.worst_violation > 1e-12) continue;  // a face's minimiser outside the box
      EXPECT_LE(iteration.energy, last + rounding);
      last = iteration.energy;
    }
  }
}

TEST(PetscsSolvers, mostly_need_no_help_from_ours) {
  constexpr unsigned count = 20;
  for (const Solver solver : {Solver::tao, Solver::snesvi}) {
    int helped = 0, iterations = 0;
    for (unsigned seed = 1; seed <= count; ++seed) {
      const DistributedProblem problem(random_problem(ranks() == 1 ? 30 : 8, seed));
      algebra::Factorisation F(problem.matrix);
      const auto solution = solve_with(solver, *problem.box, F);
      EXPECT_EQ(solution.status, Status::solved);
      helped += solution.iterations.back().safeguarded;
      iterations += static_cast<int>(solution.iterations.size());
    }
    EXPECT_LE(helped, static_cast<int>(count / 4)) << name_of(solver);
    EXPECT_GT(iterations, static_cast<int>(2 * count)) << name_of(solver);
  }
}

TEST(Solve, takes_the_solver_that_the_settings_name) {
  const DistributedProblem problem(random_problem(20, 7));
  algebra::Factorisation F(problem.matrix);
  const std::array<contact::SolverFunction*, 5> functions{contact::solve_primal_dual_active_set,
                                                          contact::solve_projected_search, contact::solve_tao,
                                                          contact::solve_snesvi, contact::solve_mprgp};
  for (std::size_t s = 0; s < functions.size(); ++s) {
    const Solver solver = contact::all_solvers[s];
    EXPECT_EQ(&contact::function_of(solver), functions[s]) << name_of(solver);
    const auto direct = functions[s](*problem.box, {}, F, {}, {});
    const auto named = solve_with(solver, *problem.box, F);
    EXPECT_EQ(gathered(direct.z), gathered(named.z)) << name_of(solver);
    EXPECT_EQ(direct.iterations.size(), named.iterations.size()) << name_of(solver);
  }
  EXPECT_EQ(contact::Settings{}.solver, Solver::active_set);
}

TEST(Solve, gives_the_solvers_the_names_of_case_files) {
  EXPECT_EQ(name_of(Solver::active_set), "active-set");
  EXPECT_EQ(name_of(Solver::projected), "projected");
  EXPECT_EQ(name_of(Solver::tao), "tao");
  EXPECT_EQ(name_of(Solver::snesvi), "snesvi");
  EXPECT_EQ(name_of(Solver::mprgp), "mprgp");
}

}  // namespace
}  // namespace plastron::test

#include <gtest/gtest.h>

#include "contact/dense_problem.hpp"

namespace plastron::test {
namespace {

using contact::BoxSolution;
using contact::Status;

// A row of springs without supports and bounds.
DenseProblem free_springs(Eigen::Index n) {
  DenseProblem problem{.A = Eigen::MatrixXd::Zero(n, n),
                       .b = Eigen::VectorXd::Zero(n),
                       .lower = Eigen::VectorXd::Constant(n, -infinity),
                       .upper = Eigen::VectorXd::Constant(n, infinity)};
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    problem.A.block(i, i, 2, 2) += Eigen::Matrix2d{{1.0 / 3, -1.0 / 3}, {-1.0 / 3, 1.0 / 3}};
  return problem;
}

DenseProblem held_springs(Eigen::Index n) {
  DenseProblem problem = free_springs(n);
  problem.lower(0) = problem.upper(0) = 0;
  return problem;
}

std::vector<BoxSolution> solve_with_all(const DenseProblem& dense, const contact::Settings& settings = {}) {
  const DistributedProblem problem(dense);
  algebra::Factorisation F(problem.matrix);
  std::vector<BoxSolution> solutions;
  solutions.reserve(solvers().size());
  for (const NamedSolver& solver : solvers()) solutions.push_back(solve_with(solver, *problem.box, F, {}, settings));
  return solutions;
}

TEST(EverySolver, calls_contradicting_bounds_infeasible) {
  DenseProblem dense = held_springs(5);
  dense.lower(3) = 1;
  dense.upper(3) = 0;
  for (const auto& solution : solve_with_all(dense)) {
    EXPECT_EQ(solution.status, Status::infeasible);
    EXPECT_TRUE(solution.iterations.empty());
  }
}

TEST(EverySolver, calls_a_structure_that_nothing_holds_singular) {
  for (const Eigen::Index n : {3, 6, 11, 24}) {
    DenseProblem dense = free_springs(n);
    dense.b(1) = 1;
    for (const auto& solution : solve_with_all(dense)) EXPECT_EQ(solution.status, Status::singular);
  }
}

TEST(Solve, finds_a_structure_at_rest_that_nothing_holds_or_loads) {
  for (const Eigen::Index n : {3, 6, 11, 24}) {
    DistributedProblem problem(free_springs(n));
    algebra::Factorisation F(problem.matrix);
    const auto at_rest = contact::solve(*problem.box, {}, F);
    EXPECT_EQ(at_rest.status, Status::solved);
    EXPECT_EQ(algebra::max_abs(at_rest.z), 0);
    EXPECT_EQ(algebra::max_abs(at_rest.multiplier), 0);
    problem.box->may_be_indefinite = true;  // rest may be no minimum then
    EXPECT_EQ(contact::solve(*problem.box, {}, F).status, Status::singular);
  }
}

TEST(EverySolver, lets_an_obstacle_alone_hold_a_structure_that_is_pressed_on_it) {
  for (const Eigen::Index n : {3, 6, 11, 24}) {
    DenseProblem dense = free_springs(n);
    dense.lower.setConstant(-1);
    dense.b.setConstant(-0.1);
    SCOPED_TRACE(std::to_string(n) + " nodes");
    for (const auto& solution : solve_with_all(dense)) {
      ASSERT_EQ(solution.status, Status::solved);
      EXPECT_LT((gathered(solution.z).array() + 1).abs().maxCoeff(), 1e-12);
      EXPECT_NEAR(gathered(solution.multiplier).sum(), 0.1 * static_cast<double>(n), 1e-12);
    }
  }
}

TEST(EverySolver, calls_a_structure_that_is_pulled_off_the_obstacle_not_held) {
  DenseProblem dense = free_springs(6);
  dense.lower.setConstant(-1);
  dense.b.setConstant(0.1);
  for (const auto& solution : solve_with_all(dense)) EXPECT_EQ(solution.status, Status::not_held);
}

TEST(EverySolver, stops_at_the_iteration_limit_with_what_it_has) {
  DenseProblem dense = held_springs(12);
  dense.lower.tail(11).setConstant(-1);
  dense.b.setConstant(-0.1);
  const contact::Settings settings{.max_iterations = 1};
  for (const auto& solution : solve_with_all(dense, settings)) {
    EXPECT_EQ(solution.status, Status::iteration_limit);
    EXPECT_EQ(solution.iterations.size(), 1u);
    EXPECT_GT(solution.iterations.back().changes, 0);
    EXPECT_EQ(gathered(solution.z).size(), 12);
  }
}

TEST(EverySolver, moves_to_prescribed_values_and_reports_their_reactions) {
  DenseProblem dense = held_springs(4);
  dense.lower(3) = dense.upper(3) = 3;
  for (const auto& solution : solve_with_all(dense)) {
    ASSERT_EQ(solution.status, Status::solved);
    EXPECT_LT((gathered(solution.z) - Eigen::Vector4d(0, 1, 2, 3)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((gathered(solution.multiplier) - Eigen::Vector4d(-1, 0, 0, 1) / 3).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(EverySolver, says_so_when_the_operator_is_not_the_matrix) {
  const DenseProblem dense = held_springs(9);
  DistributedProblem problem(dense);
  problem.box->load.fill(1.0);
  // A skewed operator: the work z' y is that of the matrix, but the system is another one.
  problem.box->apply = [&](const Vector& z, Vector& y) {
    problem.matrix.multiply(z, y);
    const auto all = gather(z);
    for (std::size_t i = 0; i < y.owned().size(); ++i) {
      const std::size_t k = static_cast<std::size_t>(y.layout()->first) + i;
      if (k + 1 < all.size()) y.owned()[i] += 40 * all[k + 1];
      if (k > 0) y.owned()[i] -= 40 * all[k - 1];
    }
  };
  algebra::Factorisation F(problem.matrix);
  EXPECT_EQ(contact::solve_primal_dual_active_set(*problem.box, {}, F).status, Status::linear_solver_stalled);
}

TEST(Observer, sees_every_iteration) {
  DenseProblem dense = held_springs(12);
  dense.lower.tail(11).setConstant(-0.1);
  dense.b.setConstant(-0.1);
  const DistributedProblem problem(dense);
  algebra::Factorisation F(problem.matrix);
  std::size_t seen = 0;
  const auto solution =
      contact::solve_primal_dual_active_set(*problem.box, {}, F, {}, {[&](const contact::Iteration&) { ++seen; }, {}});
  EXPECT_EQ(solution.status, Status::solved);
  EXPECT_EQ(seen, solution.iterations.size());
  EXPECT_EQ(solution.iterations.back().changes, 0);
  EXPECT_EQ(solution.iterations.back().active, 11);
}

TEST(Observer, can_stop_the_solver_after_any_iteration) {
  DenseProblem dense = held_springs(12);
  dense.lower.tail(11).setConstant(-0.1);
  dense.b.setConstant(-0.1);
  const DistributedProblem problem(dense);
  algebra::Factorisation F(problem.matrix);
  const auto steps = contact::solve_primal_dual_active_set(*problem.box, {}, F).iterations.size();
  ASSERT_GT(steps, 1U);
  std::size_t seen = 0;
  const contact::Observer first_only{.iteration = [&](const contact::Iteration&) { ++seen; },
                                     .stop = [] { return true; }};
  const auto solution = contact::solve_primal_dual_active_set(*problem.box, {}, F, {}, first_only);
  EXPECT_EQ(solution.status, Status::interrupted);
  EXPECT_EQ(seen, 1U);
}

TEST(Observer, can_stop_every_solver_after_its_first_iteration) {
  const DistributedProblem problem(random_problem(40, 1));
  algebra::Factorisation F(problem.matrix);
  for (const NamedSolver& solver : solvers()) {
    ASSERT_GT(solve_with(solver, *problem.box, F).iterations.size(), 1U) << solver.name;
    std::size_t seen = 0;
    const contact::Observer first_only{.iteration = [&](const contact::Iteration&) { ++seen; },
                                       .stop = [] { return true; }};
    const auto stopped = solve_with(solver, *problem.box, F, {}, {}, first_only);
    EXPECT_EQ(stopped.status, Status::interrupted) << solver.name;
    EXPECT_EQ(seen, stopped.iterations.size()) << solver.name;
    EXPECT_LE(seen, 1U) << solver.name;
  }
}

TEST(Status, has_a_name_and_an_explanation) {
  for (const Status status :
       {Status::solved, Status::iteration_limit, Status::cycling, Status::infeasible, Status::singular,
        Status::not_held, Status::not_carried, Status::linear_solver_stalled, Status::interrupted}) {
    EXPECT_NE(contact::to_string(status), "unknown");
    EXPECT_GT(contact::explain(status).size(), 20u);
  }
}

}  // namespace
}  // namespace plastron::test

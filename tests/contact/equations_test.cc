// Linear equations beside the bounds: minimise 1/2 z' A z - b' z with lower <= z <= upper and B z = 0.
#include <plastron/contact/pressing.hpp>

#include <gtest/gtest.h>

#include "contact/pressed_problem.hpp"

namespace plastron::test {
namespace {

using contact::Activity;
using contact::Status;

/// Two random equations. In every third problem the row of the second multiplier is empty.
struct WithEquations {
  WithEquations(const DenseProblem& dense, const Eigen::MatrixXd& rows) : distributed(dense), B(rows) {
    const auto layout = layout_for(B.rows(), {});
    const auto& z_layout = distributed.matrix.layout();
    distributed.box->equations =
        contact::EqualityConstraints{.multipliers = Vector(layout, 1),
                                     .apply =
                                         [this](const Vector& z, Vector& q) {
                                           const Eigen::VectorXd all = B * gathered(z);
                                           for (LocalIndex i = 0; i < q.layout()->owned; ++i)
                                             q.owned()[static_cast<std::size_t>(i)] = all(q.layout()->global(i));
                                         },
                                     .apply_transposed =
                                         [this, z_layout](const Vector& q, Vector& z) {
                                           const Eigen::VectorXd all = B.transpose() * gathered(q);
                                           for (LocalIndex i = 0; i < z_layout->owned; ++i)
                                             z.owned()[static_cast<std::size_t>(i)] = all(z_layout->global(i));
                                         },
                                     .precondition = [](const Vector& q, Vector& p) { p = q; }};
  }
  DistributedProblem distributed;
  Eigen::MatrixXd B;
};

void expect_all_conditions(const DenseProblem& dense, const Eigen::MatrixXd& B, const contact::BoxSolution& solution) {
  ASSERT_EQ(solution.status, Status::solved);
  const Eigen::VectorXd z = gathered(solution.z), q = gathered(solution.equation_multiplier);
  const Eigen::VectorXd m = dense.A * z + B.transpose() * q - dense.b;
  EXPECT_NEAR((B * z).norm(), 0, 1e-8);
  EXPECT_NEAR((m - gathered(solution.multiplier)).norm(), 0, 1e-8);
  for (Eigen::Index i = 0; i < 8; ++i) {
    EXPECT_GE(z(i), dense.lower(i) - 1e-8);
    EXPECT_LE(z(i), dense.upper(i) + 1e-8);
    if (z(i) > dense.lower(i) + 1e-7) {
      EXPECT_LE(m(i), 1e-8);
    }
    if (z(i) < dense.upper(i) - 1e-7) {
      EXPECT_GE(m(i), -1e-8);
    }
  }
}

/// The least y' B z over the box.
double least_in_box(const DenseProblem& dense, const Eigen::VectorXd& row) {
  double least = 0;
  for (Eigen::Index i = 0; i < row.size(); ++i)
    if (row(i) != 0) least += row(i) * (row(i) > 0 ? dense.lower(i) : dense.upper(i));
  return least;
}

/// Whether no point of the box has B z = 0: some combination y of the two equations is positive on the whole box. If an unknown has no bound,
/// the combination must not contain it. So the directions orthogonal to each column of B are tried besides many others.
bool cannot_hold(const DenseProblem& dense, const Eigen::MatrixXd& B) {
  constexpr int directions = 3600;
  constexpr double positive = 1e-9;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * std::acos(-1.0) * k / directions;
    if (least_in_box(dense, B.transpose() * Eigen::Vector2d(std::cos(angle), std::sin(angle))) > positive) return true;
  }
  for (Eigen::Index i = 0; i < B.cols(); ++i) {
    Eigen::VectorXd row = B.transpose() * Eigen::Vector2d(-B(1, i), B(0, i)).normalized();
    row(i) = 0;
    if (least_in_box(dense, row) > positive || least_in_box(dense, -row) > positive) return true;
  }
  return false;
}

TEST(Equations, HoldTogetherWithAllConditionsOfTheBounds) {
  const unsigned problems = ranks() == 1 ? 120 : 4;  // MUMPS is slow on tiny systems
  unsigned feasible = 0, given_up = 0;
  for (unsigned seed = 0; seed < problems; ++seed) {
    DenseProblem dense = random_problem(8, seed);
    for (Eigen::Index i = 0; i < 8; ++i)
      if (dense.lower(i) == dense.upper(i)) dense.upper(i) = infinity;  // leave room for the equations
    std::mt19937 random(seed + 1000);
    std::normal_distribution<double> normal;
    const Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(2, 8, [&] { return normal(random); });
    WithEquations problem(dense, B);
    algebra::Factorisation factorisation(problem.distributed.matrix);
    const bool is_feasible = !cannot_hold(dense, B);
    feasible += is_feasible;
    for (const NamedSolver& solver : solvers()) {
      SCOPED_TRACE(solver.name + ", seed " + std::to_string(seed));
      const auto solution =
          solve_with(solver, *problem.distributed.box, factorisation, {}, {.detect_free_motions = false});
      if (solution.status == Status::cycling || solution.status == Status::iteration_limit) {
        ++given_up;  // not found, with a status that says so
        continue;
      }
      if (is_feasible)
        expect_all_conditions(dense, B, solution);
      else
        EXPECT_EQ(solution.status, Status::infeasible);
    }
  }
  EXPECT_GE(feasible, 4 * problems / 5);
  EXPECT_LE(given_up, solvers().size() * problems / 30);
}

TEST(Equations, AnEmptyRowKeepsAZeroMultiplier) {
  const DenseProblem dense{.A = Eigen::MatrixXd::Identity(4, 4),
                           .b = Eigen::VectorXd::LinSpaced(4, 1, 4),
                           .lower = Eigen::VectorXd::Constant(4, -infinity),
                           .upper = Eigen::VectorXd::Constant(4, infinity)};
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(2, 4);
  B.row(0) << 1, 1, 1, 1;
  WithEquations problem(dense, B);
  algebra::Factorisation factorisation(problem.distributed.matrix);
  const auto solution = contact::solve_primal_dual_active_set(*problem.distributed.box, {}, factorisation);
  ASSERT_EQ(solution.status, Status::solved);
  EXPECT_NEAR(gathered(solution.z).sum(), 0, 1e-12);
  EXPECT_NEAR(gathered(solution.equation_multiplier)(0), 2.5, 1e-12);
  EXPECT_EQ(gathered(solution.equation_multiplier)(1), 0);
}

TEST(Equations, HoldTogetherWithForcesThatPressTheBounds) {
  const unsigned problems = ranks() == 1 ? 40 : 2;
  for (unsigned seed = 0; seed < problems; ++seed) {
    PressedDense dense = random_pressed(8, 1 + seed % 2, seed);
    for (Eigen::Index i = 0; i < 8; ++i)
      if (std::isfinite(dense.box.lower(i))) dense.box.upper(i) = no_bound;  // leave room for the equations
    std::mt19937 random(seed + 1000);
    std::normal_distribution<double> normal;
    const Eigen::MatrixXd B = Eigen::MatrixXd::NullaryExpr(2, 8, [&] { return normal(random); });
    const DistributedPressed pressed(dense);
    WithEquations problem(dense.box, B);
    problem.distributed.box->pressing = pressed.problem().pressing;
    algebra::Factorisation factorisation(problem.distributed.matrix);
    std::optional<double> energy;
    for (const NamedSolver& solver : solvers()) {
      SCOPED_TRACE(solver.name + ", seed " + std::to_string(seed));
      const auto solution = solve_with(solver, *problem.distributed.box, factorisation, {},
                                       {.max_iterations = 2000, .detect_free_motions = false});
      expect_all_conditions(dense.at(positions_of(solution)), B, solution);
      const auto answers = contact::reactions(*problem.distributed.box, solution.multiplier, solution.activity);
      for (Eigen::Index k = 0; k < dense.force.size(); ++k)
        EXPECT_NEAR(answers[static_cast<std::size_t>(k)], dense.force(k), 1e-9 * dense.force(k));
      const double found = energy_of(dense, gathered(solution.z), positions_of(solution));
      EXPECT_NEAR(found, energy.value_or(found), 1e-8 * (1 + std::abs(found)));
      energy = found;
    }
  }
}

}  // namespace
}  // namespace plastron::test

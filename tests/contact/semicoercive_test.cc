// Structures that only bounds hold. A has free motions (rigid ones), and the load presses these on bounds, or does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "contact/expect_solution.hpp"

namespace plastron::test {
namespace {

using contact::Activity;
using contact::Status;

/// A = G G' as a matrix, and as an operator that goes through G' z, as a shell's operator goes through strains.
struct FreeStructure {
  FreeStructure(const DenseProblem& dense, Eigen::MatrixXd factor) : problem(dense), G(std::move(factor)) {
    problem.box->apply = [this](const Vector& z, Vector& y) {
      const Eigen::VectorXd all = G * (G.transpose() * gathered(z));
      for (std::size_t i = 0; i < y.owned().size(); ++i)
        y.owned()[i] = all(static_cast<Eigen::Index>(y.layout()->first) + static_cast<Eigen::Index>(i));
    };
  }
  DistributedProblem problem;
  Eigen::MatrixXd G;
};

/// n unknowns with `free_motions` combinations that cost nothing. The solution is made first, on a random active set that holds all
/// motions, with multipliers of the right signs.
struct MadeProblem {
  DenseProblem dense{};
  Eigen::MatrixXd G{};
  Eigen::VectorXd exact{};
};

MadeProblem problem_with_solution(Eigen::Index n, Eigen::Index free_motions, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(random); };
  const auto positive = [&] { return 0.1 + std::abs(normal(random)); };
  MadeProblem made{.G = Eigen::MatrixXd::NullaryExpr(n, n - free_motions, draw)};
  made.dense = {.A = made.G * made.G.transpose(),
                .b = {},
                .lower = Eigen::VectorXd::Constant(n, -infinity),
                .upper = Eigen::VectorXd::Constant(n, infinity)};
  made.exact = Eigen::VectorXd::NullaryExpr(n, draw);
  Eigen::VectorXd multiplier = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::shuffle(order, random);
  const auto active = std::uniform_int_distribution<Eigen::Index>(free_motions, n)(random);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index i = order[static_cast<std::size_t>(k)];
    const bool from_below = random() % 3 > 0, from_above = !from_below || random() % 2 > 0;
    if (from_below) made.dense.lower(i) = made.exact(i) - (k < active ? 0 : positive());
    if (from_above) made.dense.upper(i) = made.exact(i) + (k < active && !from_below ? 0 : positive());
    if (k < active) multiplier(i) = (from_below ? 1 : -1) * positive();
  }
  made.dense.b = made.dense.A * made.exact - multiplier;
  return made;
}

/// A free beam, or with `differences` = 1 a free chain of springs: A = G G' with the differences of that order in the columns of G.
Eigen::MatrixXd differences_of(Eigen::Index n, int order) {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n, n - order);
  for (Eigen::Index k = 0; k < n - order; ++k)
    if (order == 1)
      G.col(k).segment(k, 2) << -1, 1;
    else
      G.col(k).segment(k, 3) << 1, -2, 1;
  return G;
}

/// A beam on uneven ground.
DenseProblem on_the_ground(const Eigen::MatrixXd& G, const Eigen::VectorXd& load, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Index n = G.rows();
  return {.A = G * G.transpose(),
          .b = load,
          .lower = Eigen::VectorXd::NullaryExpr(n, [&] { return 0.3 * normal(random); }),
          .upper = Eigen::VectorXd::Constant(n, infinity)};
}

Eigen::VectorXd random_weight(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0.01, 0.2);
  return Eigen::VectorXd::NullaryExpr(n, [&] { return -weight(random); });
}

std::vector<Activity> arbitrary_set(const contact::BoxProblem& box, unsigned start) {
  std::vector<Activity> set(box.load.owned().size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto k = static_cast<unsigned>(box.load.layout()->first) + static_cast<unsigned>(i);
    set[i] = static_cast<Activity>((start * 7 + k * k) % 3);
  }
  return set;
}

TEST(EverySolver, FindsTheSolutionThatBoundsAloneHold) {
  const unsigned problems = ranks() == 1 ? 300 : 7;
  for (unsigned seed = 1; seed <= problems; ++seed) {
    const Eigen::Index n = 3 + seed % 7, free_motions = 1 + seed % std::min<unsigned>(3, static_cast<unsigned>(n) - 1);
    const MadeProblem made = problem_with_solution(n, free_motions, seed);
    FreeStructure structure(made.dense, made.G);
    algebra::Factorisation F(structure.problem.matrix);
    for (const NamedSolver& solver : solvers()) {
      SCOPED_TRACE(solver.name + ", seed " + std::to_string(seed));
      expect_solution(*structure.problem.box,
                      solve_with(solver, *structure.problem.box, F, arbitrary_set(*structure.problem.box, seed)),
                      made.exact);
    }
  }
}

TEST(EverySolver, LaysAFreeBeamOnUnevenGroundAsBruteForceDoes) {
  const unsigned problems = ranks() == 1 ? 100 : 5;
  for (unsigned seed = 1; seed <= problems; ++seed) {
    const Eigen::Index n = 4 + seed % 4;
    const Eigen::MatrixXd G = differences_of(n, 1 + static_cast<int>(seed % 2));
    const DenseProblem dense = on_the_ground(G, random_weight(n, seed), seed);
    const auto exact = brute_force(dense);
    ASSERT_TRUE(exact);
    FreeStructure structure(dense, G);
    algebra::Factorisation F(structure.problem.matrix);
    for (const NamedSolver& solver : solvers())
      for (const unsigned start : {0u, seed}) {
        SCOPED_TRACE(solver.name + ", seed " + std::to_string(seed) + ", start " + std::to_string(start));
        const auto initial = start > 0 ? arbitrary_set(*structure.problem.box, start) : std::vector<Activity>{};
        expect_solution(*structure.problem.box, solve_with(solver, *structure.problem.box, F, initial), *exact);
      }
  }
}

// A very small weight high over the ground: its support is far away. (From 1e6 times its size the active set gives up: rounding.)
TEST(EverySolver, LetsABeamFallFar) {
  for (const double height : {1.0, 1e3}) {
    const Eigen::Index n = 6;
    const Eigen::MatrixXd G = differences_of(n, 2);
    DenseProblem dense = on_the_ground(G, 1e-3 * random_weight(n, 1), 2);
    const auto exact = brute_force(dense);
    ASSERT_TRUE(exact);
    dense.lower.array() -= height;
    FreeStructure structure(dense, G);
    algebra::Factorisation F(structure.problem.matrix);
    for (const NamedSolver& solver : solvers()) {
      SCOPED_TRACE(solver.name + ", from " + std::to_string(height));
      const auto solution = solve_with(solver, *structure.problem.box, F);
      ASSERT_EQ(solution.status, Status::solved);
      EXPECT_LT((gathered(solution.z) - (exact->array() - height).matrix()).cwiseAbs().maxCoeff(), 1e-13 * height);
    }
  }
}

// The ground ends before the middle of the weight: the beam tips over its edge.
TEST(EverySolver, RefusesABeamThatTipsOffTheGround) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Eigen::Index n = 6 + seed % 4;
    const Eigen::MatrixXd G = differences_of(n, 2);
    DenseProblem dense = on_the_ground(G, Eigen::VectorXd::Constant(n, -0.1), seed);
    dense.lower.tail(n - n / 2 + 1).setConstant(-infinity);
    FreeStructure structure(dense, G);
    algebra::Factorisation F(structure.problem.matrix);
    for (const NamedSolver& solver : solvers()) {
      SCOPED_TRACE(solver.name + ", seed " + std::to_string(seed));
      EXPECT_EQ(solve_with(solver, *structure.problem.box, F).status, Status::not_held);
    }
  }
}

// The finer the beam, the softer are its bending motions beside the free ones.
TEST(PrimalDualActiveSet, LaysAFineFreeBeamOnBumpsInFewSteps) {
  for (const Eigen::Index n : {30, 60, 120}) {
    const Eigen::MatrixXd G = differences_of(n, 2);
    const double h = 1.0 / static_cast<double>(n);
    DenseProblem dense = on_the_ground(G, Eigen::VectorXd::Constant(n, -400 * h * h * h * h), 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double x = (static_cast<double>(i) + 0.5) * h;
      dense.lower(i) = 0.2 * x + 0.05 * std::sin(17 * x) + 0.02 * std::cos(41 * x);
    }
    FreeStructure structure(dense, G);
    algebra::Factorisation F(structure.problem.matrix);
    for (contact::SolverFunction* solver : {contact::solve_primal_dual_active_set, contact::solve_projected_search}) {
      SCOPED_TRACE(std::to_string(n) + " nodes");
      const auto solution = solver(*structure.problem.box, {}, F, {}, {});
      ASSERT_EQ(solution.status, Status::solved);
      EXPECT_LE(solution.iterations.size(), 25u);
      const Eigen::VectorXd z = gathered(solution.z), multiplier = gathered(solution.multiplier);
      EXPECT_GE((z - dense.lower).minCoeff(), -1e-9);
      EXPECT_GE(multiplier.minCoeff(), -1e-9 * multiplier.maxCoeff());
      EXPECT_NEAR(multiplier.sum(), -dense.b.sum(), 1e-8 * multiplier.sum());
    }
  }
}

}  // namespace
}  // namespace plastron::test

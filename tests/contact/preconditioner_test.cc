// The contact solvers with a preconditioner that has no factor give what they give with a factorisation.
#include <plastron/contact/primal_dual_active_set.hpp>
#include <plastron/contact/projected_search.hpp>

#include <gtest/gtest.h>

#include "algebra/beam.hpp"
#include "contact/dense_problem.hpp"
#include "contact/jacobi.hpp"

namespace plastron::test {
namespace {

using algebra::Pinning;
using contact::BoxProblem;
using contact::BoxSolution;
using contact::Status;

void expect_the_same(const BoxSolution& a, const BoxSolution& b) {
  ASSERT_EQ(a.status, Status::solved);
  ASSERT_EQ(b.status, Status::solved);
  const double size = algebra::max_abs(a.z), force = algebra::max_abs(a.multiplier);
  for (std::size_t i = 0; i < a.activity.size(); ++i) {
    EXPECT_NEAR(a.z.owned()[i], b.z.owned()[i], 1e-8 * (1 + size));
    EXPECT_NEAR(a.multiplier.owned()[i], b.multiplier.owned()[i], 1e-8 * (1 + force));
  }
  EXPECT_EQ(a.activity, b.activity);
}

void expect_the_same_without_a_factor(const BoxProblem& problem) {
  algebra::Factorisation F(problem.matrix);
  Jacobi D(problem.matrix);
  expect_the_same(contact::solve_primal_dual_active_set(problem, {}, F),
                  contact::solve_primal_dual_active_set(problem, {}, D));
  expect_the_same(contact::solve_projected_search(problem, {}, F), contact::solve_projected_search(problem, {}, D));
}

TEST(WithoutAFactor, RandomProblemsHaveTheSameSolution) {
  const unsigned problems = ranks() == 1 ? 100 : 3;  // MUMPS takes its time on tiny systems
  for (unsigned seed = 1; seed <= problems; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const DistributedProblem problem(random_problem(1 + seed % 9, seed));
    expect_the_same_without_a_factor(*problem.box);
  }
}

// Conjugate gradients alone need many more steps than the thirty that refine an exact preconditioner.
TEST(WithoutAFactor, ABeamOnATableLiesTheSame) {
  const Beam beam(ranks() == 1 ? 41 : 25);
  BoxProblem problem{.matrix = beam.matrix,
                     .apply = [&](const Vector& z, Vector& y) { beam.apply(z, y); },
                     .load = Vector(beam.layout, 1),
                     .lower = Vector(beam.layout, 1),
                     .upper = Vector(beam.layout, 1)};
  problem.load.fill(-3000 * std::pow(1.0 / static_cast<double>(beam.layout->global_size), 4));
  problem.lower.fill(-1);
  problem.upper.fill(infinity);
  const auto clamped = beam.ends(2);
  for (std::size_t i = 0; i < clamped.size(); ++i)
    if (clamped[i]) problem.lower.owned()[i] = problem.upper.owned()[i] = 0;
  expect_the_same_without_a_factor(problem);
  Jacobi D(beam.matrix);
  const auto solution = contact::solve_primal_dual_active_set(problem, {}, D);
  EXPECT_GT(solution.iterations.front().linear_steps, 10);  // a factor takes two
  EXPECT_EQ(D.pinnings, static_cast<int>(solution.iterations.size()));
}

// Springs in a row, held by nothing but perhaps an obstacle.
DenseProblem free_springs(Eigen::Index n, double load) {
  DenseProblem problem{.A = Eigen::MatrixXd::Zero(n, n),
                       .b = Eigen::VectorXd::Constant(n, load),
                       .lower = Eigen::VectorXd::Constant(n, -infinity),
                       .upper = Eigen::VectorXd::Constant(n, infinity)};
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    problem.A.block(i, i, 2, 2) += Eigen::Matrix2d{{1.0 / 3, -1.0 / 3}, {-1.0 / 3, 1.0 / 3}};
  return problem;
}

TEST(WithoutAFactor, FreeMotionsAreFoundAllTheSame) {
  for (const Eigen::Index n : {3, 11}) {
    SCOPED_TRACE(n);
    DenseProblem dense = free_springs(n, 0.1);
    const DistributedProblem nothing_holds(dense);
    Jacobi D(nothing_holds.matrix);
    EXPECT_EQ(contact::solve_primal_dual_active_set(*nothing_holds.box, {}, D).status, Status::singular);
    dense.lower.setConstant(-1);
    const DistributedProblem pulled_off(dense);
    Jacobi E(pulled_off.matrix);
    EXPECT_EQ(contact::solve_primal_dual_active_set(*pulled_off.box, {}, E).status, Status::not_held);
    EXPECT_EQ(contact::solve_projected_search(*pulled_off.box, {}, E).status, Status::not_held);
    dense.b.setConstant(-0.1);
    const DistributedProblem pressed(dense);
    expect_the_same_without_a_factor(*pressed.box);
  }
}

TEST(WithoutAFactor, EquationsHoldToo) {
  DenseProblem dense = random_problem(8, 3);
  dense.upper.setConstant(infinity);
  const DistributedProblem problem(dense);
  const auto layout = layout_for(1, {});
  BoxProblem box = *problem.box;
  const Eigen::RowVectorXd B = Eigen::RowVectorXd::LinSpaced(8, -1, 2);
  box.equations = contact::EqualityConstraints{
      .multipliers = Vector(layout, 1),
      .apply =
          [&](const Vector& z, Vector& q) {
            const double all = B * gathered(z);
            for (double& value : q.owned()) value = all;
          },
      .apply_transposed =
          [&](const Vector& q, Vector& z) {
            const double all = gathered(q)(0);
            for (std::size_t i = 0; i < z.owned().size(); ++i)
              z.owned()[i] = B(static_cast<Eigen::Index>(z.layout()->first) + static_cast<Eigen::Index>(i)) * all;
          },
      .precondition = [](const Vector& q, Vector& p) { p = q; }};
  algebra::Factorisation F(box.matrix);
  Jacobi D(box.matrix);
  const contact::Settings settings{.detect_free_motions = false};
  const auto with = contact::solve_primal_dual_active_set(box, {}, F, settings);
  const auto without = contact::solve_primal_dual_active_set(box, {}, D, settings);
  expect_the_same(with, without);
  EXPECT_NEAR(B * gathered(without.z), 0, 1e-8);
  EXPECT_GT(std::abs(gathered(with.equation_multiplier)(0)), 1e-3);
}

// A preconditioner that cannot be pinned, and why.
class Failing : public Jacobi {
 public:
  Failing(const Matrix& A, Pinning why) : Jacobi(A), why_(why) {}
  Pinning pin(std::span<const char>, double) override { return why_; }

 private:
  Pinning why_;
};

TEST(Preconditioner, ThatCannotBePinnedSaysWhyAndTheSolversTellIt) {
  const DistributedProblem problem(random_problem(6, 1));
  for (const auto& [why, status] :
       {std::pair{Pinning::not_positive_definite, Status::singular}, std::pair{Pinning::not_finite, Status::not_finite},
        std::pair{Pinning::not_converged, Status::linear_solver_stalled}}) {
    Failing failing(problem.matrix, why);
    EXPECT_EQ(contact::solve_primal_dual_active_set(*problem.box, {}, failing).status, status);
    EXPECT_EQ(contact::solve_projected_search(*problem.box, {}, failing).status, status);
  }
}

TEST(InitialActiveSet, OfAWrongSizeOnOneRankIsRefusedOnAll) {
  const DistributedProblem problem(random_problem(6, 1));
  Jacobi D(problem.matrix);
  std::vector<contact::Activity> initial(problem.box->load.owned().size(), contact::Activity::free);
  if (rank() == ranks() - 1) initial.push_back(contact::Activity::free);
  EXPECT_THROW(contact::solve_primal_dual_active_set(*problem.box, initial, D), std::invalid_argument);
}

}  // namespace
}  // namespace plastron::test

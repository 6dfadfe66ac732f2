// The referees solve what the library's contact solvers solve: the tests EverySolver of tests/contact examine them in
// this program. Beside these, each does it in its own way.
#include <plastron/algebra/factorisation.hpp>
#include <research/referees/faces.hpp>
#include <research/referees/solvers.hpp>

#include <gtest/gtest.h>

#include "algebra/allocations.hpp"
#include "contact/dense_problem.hpp"

namespace plastron::test {

std::vector<NamedSolver> solvers() { return {{"tao", referees::solve_tao}, {"mprgp", referees::solve_mprgp}}; }

namespace {

using contact::Status;

TEST(Mprgp, factorises_once) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const DistributedProblem problem(random_problem(40, seed));
    algebra::Factorisation F(problem.matrix);
    const auto solution = referees::solve_mprgp(*problem.box, {}, F);
    EXPECT_EQ(solution.status, Status::solved);
    EXPECT_EQ(F.factorisations(), 1);
    EXPECT_GT(solution.iterations.size(), 1U);
  }
}

TEST(Mprgp, lowers_the_energy_at_every_step) {
  for (unsigned seed = 1; seed <= (ranks() == 1 ? 10U : 3U); ++seed) {
    const DistributedProblem problem(random_problem(30, seed));
    algebra::Factorisation F(problem.matrix);
    const auto solution = referees::solve_mprgp(*problem.box, {}, F);
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

TEST(Tao, mostly_needs_no_help_from_the_projected_search) {
  constexpr unsigned count = 20;
  int helped = 0, iterations = 0;
  for (unsigned seed = 1; seed <= count; ++seed) {
    const DistributedProblem problem(random_problem(ranks() == 1 ? 30 : 8, seed));
    algebra::Factorisation F(problem.matrix);
    const auto solution = referees::solve_tao(*problem.box, {}, F);
    EXPECT_EQ(solution.status, Status::solved);
    helped += solution.iterations.back().safeguarded;
    iterations += static_cast<int>(solution.iterations.size());
  }
  EXPECT_LE(helped, static_cast<int>(count / 4));
  EXPECT_GT(iterations, static_cast<int>(2 * count));
}

TEST(StepsOfSolvers, are_made_without_new_vectors) {
  const DistributedProblem problem(random_problem(12, 1));
  const contact::BoxProblem& box = *problem.box;
  const Vector diagonal = referees::positive_diagonal(box);
  const referees::ScaledUnknowns scaled(box);
  algebra::Factorisation F(problem.matrix);
  referees::FacePreconditioner preconditioner(F, diagonal);
  const contact::ActiveSet all_free(box.load.owned().size(), contact::Activity::free);
  ASSERT_TRUE(preconditioner.fix(box, all_free, false));
  const Vector x = box.load;
  Vector y = x, z = x;
  const auto step = [&] {
    scaled.apply(x, y);
    preconditioner.apply(y, z);
  };
  step();
  const Allocations allocations;
  step();
  EXPECT_EQ(allocations.count(), 0);
}

}  // namespace
}  // namespace plastron::test

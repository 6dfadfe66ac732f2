// Linear shells with known answers, locking, and round-off.
#include "verification/figures.hpp"
#include "verification/reference_problems.hpp"

#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/computation/solve.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace plastron::verification::linear_references_test {
namespace {

const auto* const figures = testing::AddGlobalTestEnvironment(new EveryFigureIsHeld("verification_linear"));

struct Outcome {
  double displacement;  ///< relative error
  double energy;        ///< relative error, 0 where no reference is known
  std::int64_t unknowns;
};

Outcome solve(const LinearReference& reference) {
  const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved);
  const Outcome outcome{result.probes.front().values.u.dot(reference.direction) / reference.displacement - 1,
                        reference.energy ? result.summary.energy.total() / *reference.energy - 1 : 0,
                        result.levels.back().unknowns};
  return outcome;
}

LinearReference saddle(double thickness, int refinements) {
  return hyperbolic_paraboloid(thickness, ShearCorrection::one, false, 2, refinements);
}

TEST(Locking, DegreeTwoWithTyingIsWithinOnePercentAtTwentyOneThousandUnknownsForEveryThickness) {
  for (const double thickness : {1e-2, 1e-3, 1e-4}) {
    const Outcome outcome = solve(saddle(thickness, 4));
    EXPECT_LT(outcome.unknowns, 22'000);
    EXPECT_LT(std::abs(outcome.displacement), 0.01) << thickness;
    expect_figure("locking", fmt::format("{:g}", thickness), "unknowns", outcome.unknowns);
    expect_figure("locking", fmt::format("{:g}", thickness), "tying on", outcome.displacement);
  }
}

TEST(Locking, WithoutTyingTheSameElementsLockTheMoreTheThinner) {
  double before = 0;
  for (const double thickness : {1e-2, 1e-3, 1e-4}) {
    LinearReference reference = saddle(thickness, 4);
    reference.problem.shell.tying = false;
    const double error = solve(reference).displacement;
    EXPECT_LT(error, before);
    expect_figure("locking", fmt::format("{:g}", thickness), "tying off", error);
    before = error;
  }
  EXPECT_LT(before, -0.5);
}

// The threshold of the warning: it comes with errors of 10 % and more, and not with errors below 2 %.
TEST(Locking, TrianglesOfEitherDegreeLockAndAreWarnedAbout) {
  struct Mesh {
    int degree;
    double thickness;
    int refinements;
  };
  int locking = 0, sound = 0;
  for (const Mesh m : {Mesh{1, 1e-2, 5}, Mesh{2, 1e-2, 2}, Mesh{2, 1e-2, 4}, Mesh{2, 1e-3, 3}, Mesh{2, 1e-3, 5}}) {
    LinearReference reference =
        hyperbolic_paraboloid(m.thickness, ShearCorrection::one, false, m.degree, m.refinements);
    reference.problem.discretisation.cells = mesh::Shape::triangle;
    const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
    ASSERT_EQ(result.status, contact::Status::solved);
    const double error = result.probes.front().values.u.dot(reference.direction) / reference.displacement - 1;
    fmt::print("triangles on the hyperbolic paraboloid, e = {}, degree {} unknowns {}: {:+.1f} %{}\n", m.thickness,
               m.degree, result.levels.back().unknowns, 100 * error, result.warnings.empty() ? "" : ", warned");
    if (error < -0.1) {
      ++locking;
      EXPECT_EQ(result.warnings.size(), 1u);
    }
    if (error > -0.02) {
      ++sound;
      EXPECT_TRUE(result.warnings.empty());
    }
  }
  EXPECT_EQ(locking, 3);
  EXPECT_EQ(sound, 1);
}

// The corners where the clamped edge ends limit the rate, whatever the degree.
TEST(LinearReferences, TheSaddleConvergesAsItsCornersAllow) {
  for (const int degree : {2, 3, 4}) {
    LinearReference reference = saddle(1e-2, degree == 2 ? 4 : 3);
    reference.problem.discretisation.degree = degree;
    const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
    ASSERT_EQ(result.status, contact::Status::solved);
    std::vector<double> errors, rates;
    for (const computation::Level& level : result.levels)
      errors.push_back(std::abs(level.energy / *reference.energy - 1));
    for (std::size_t l = errors.size() - 2; l < errors.size(); ++l)
      rates.push_back(std::log2(errors[l - 1] / errors[l]));
    expect_figure("corners", std::to_string(degree), "rate", rates);
  }
}

TEST(LinearReferences, TheFreeHyperboloid) {
  for (const double thickness : {0.1, 0.01})
    for (const auto k : {ShearCorrection::one, ShearCorrection::five_sixths}) {
      const Outcome outcome = solve(free_hyperboloid(thickness, k, 6, 3));
      EXPECT_LE(outcome.unknowns, 60'000);
      EXPECT_LT(std::abs(outcome.displacement), 1e-4);
    }
}

TEST(LinearReferences, TheScordelisLoRoof) {
  for (const auto k : {ShearCorrection::one, ShearCorrection::five_sixths}) {
    const Outcome hard = solve(scordelis_lo(k, true, 5, 3));
    EXPECT_LE(hard.unknowns, 60'000);
    EXPECT_LT(std::abs(hard.displacement), 1e-4);
  }
}

TEST(LinearReferences, TheClampedPlate) {
  for (const double thickness : {0.1, 0.01})
    for (const auto k : {ShearCorrection::one, ShearCorrection::five_sixths})
      EXPECT_LT(std::abs(solve(clamped_plate(thickness, k, 4, 3)).displacement), 1e-4);
}

TEST(RoundOff, ResidualsThroughStrainsKeepTheEnergyIdentityAtDegreeEightAndThicknessOneTenThousandth) {
  LinearReference reference = saddle(1e-4, 3);
  reference.problem.discretisation.degree = 8;
  const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  EXPECT_LT(result.certificate.energy_identity, 1e-8);
  expect_figure("round-off", "residuals through strains", "energy identity", result.certificate.energy_identity);

  // The same problem solved with the assembled matrix alone: one factorisation, one solution.
  const assembly::DiscreteShell& discrete = *result.solution->discrete;
  const algebra::Matrix A = assembly::stiffness_matrix(discrete);
  const contact::BoxProblem box = assembly::box_problem(discrete, A);
  algebra::Factorisation F(A);
  algebra::Vector load = box.load, z(box.load.layout(), 5);
  std::vector<char> fixed(load.owned().size());
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    fixed[i] = box.lower.owned()[i] == box.upper.owned()[i];
    if (fixed[i]) load.owned()[i] = 0;
  }
  ASSERT_TRUE(F.factorise(fixed));
  F.solve(load, z);
  z.update_ghosts();
  const contact::BoxSolution solution{.z = std::move(z), .activity = std::vector<contact::Activity>(fixed.size())};
  const auto verdict = certificate::certify(discrete, solution::nodal_solution(discrete, solution));
  expect_figure("round-off", "one direct solve", "energy identity", verdict.certificate.energy_identity);
  EXPECT_GT(verdict.certificate.energy_identity, 10 * result.certificate.energy_identity);
}

}  // namespace
}  // namespace plastron::verification::linear_references_test

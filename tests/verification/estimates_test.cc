// Estimated errors beside true ones (docs/methods/estimates.md): manufactured shells in the energy norm, references with known energies and
// reactions.
#include "verification/error_norm.hpp"
#include "verification/reference_problems.hpp"

#include <plastron/computation/solve.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plastron::verification {
namespace {

/// Estimated over true error in the energy norm.
double effectivity(const Manufactured& exact, int degree, int refinements) {
  const computation::Result result =
      computation::solve(manufactured_problem(exact, degree, refinements), MPI_COMM_WORLD);
  EXPECT_TRUE(result.estimates && result.solution);
  if (!result.estimates || !result.solution) return NAN;
  return std::sqrt(result.estimates->energy_norm_squared / (2 * result.summary.energy.total())) /
         energy_error(*result.solution, exact);
}

TEST(EstimatedEnergyNorm, IsThatOfTheErrorInThickAndThinShells) {
  for (const double e : {1.0, 0.1, 0.01})
    for (const auto& [degree, refinements] : {std::pair{2, 3}, {3, 2}, {4, 2}}) {
      const double ratio = effectivity({ManufacturedSolution::clamped, {.thickness = e}}, degree, refinements);
      EXPECT_GT(ratio, 0.5) << fmt::format("e = {}, degree {}", e, degree);
      EXPECT_LT(ratio, 1.6) << fmt::format("e = {}, degree {}", e, degree);
    }
}

TEST(EstimatedEnergyNorm, IsThatOfTheErrorInContact) {
  for (const auto& [degree, refinements] : {std::pair{2, 3}, {3, 3}, {4, 2}}) {
    const double ratio = effectivity({ManufacturedSolution::contact, {.thickness = 0.1}}, degree, refinements);
    EXPECT_GT(ratio, 0.5) << "degree " << degree;
    EXPECT_LT(ratio, 3) << "degree " << degree;
  }
}

// R1 without contact: a beam whose tied solution is right at its nodes. The energy that tying removes decides the sign.
TEST(EstimatedEnergy, HasTheRightSignAndSizeWithoutContact) {
  for (const int refinements : {2, 3}) {
    const ContactReference reference = contact_reference("R1_e0.1_P0.2", 2, refinements);
    const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
    ASSERT_TRUE(result.estimates);
    const double error = reference.energy / reference.factor - result.summary.energy.total();
    EXPECT_NEAR(result.estimates->goals.front().estimate, error, 0.02 * std::abs(error));
  }
}

TEST(EstimatedEnergy, HasTheRightSignAndSizeOnAThinCurvedShell) {
  const Manufactured exact(ManufacturedSolution::clamped, {.thickness = 0.01});
  const auto solved = [&](int degree, int refinements) {
    return computation::solve(manufactured_problem(exact, degree, refinements), MPI_COMM_WORLD);
  };
  const double energy = solved(6, 2).summary.energy.total();
  for (const auto& [degree, refinements] : {std::pair{2, 3}, {3, 2}}) {
    const computation::Result result = solved(degree, refinements);
    ASSERT_TRUE(result.estimates);
    const double error = energy - result.summary.energy.total();
    EXPECT_NEAR(result.estimates->goals.front().estimate, error, 0.7 * std::abs(error)) << "degree " << degree;
  }
}

// M_nt vanishes at free edges within e/sqrt(12 k_s), a thousandth of these shells. No cell of theirs resolves this layer, and no patch sees it.
TEST(EstimatedEnergy, KnowsOfTheShearLayerOfFreeEdges) {
  const auto k = ShearCorrection::five_sixths;
  const auto look = [](const LinearReference& coarse, double exact) {
    const computation::Result result = computation::solve(coarse.problem, MPI_COMM_WORLD);
    ASSERT_TRUE(result.estimates) << coarse.name;
    const double error = exact - result.summary.energy.total(), estimate = result.estimates->goals.front().estimate;
    EXPECT_GT(estimate, 0.5 * error) << coarse.name;
    EXPECT_LT(estimate, 3 * error) << coarse.name;
  };
  constexpr double roof = 1208.88995, hyperboloid = 3.25592163e-4;  // this program at degree 6 with 4 refinements
  for (const int refinements : {1, 2}) look(scordelis_lo(k, true, 4, refinements), roof);
  look(free_hyperboloid(0.01, k, 4, 2), hyperboloid);
}

// The edge of the contact zone crosses cells at random. True errors pass through zero, estimates do not.
TEST(EstimatedErrorsInContact, AreSeldomMuchTooSmallOrTooLarge) {
  int all = 0, too_small = 0, too_large = 0;
  for (const std::string& name : contact_reference_names())
    for (const auto& [degree, refinements] : {std::pair{2, 3}, {3, 2}, {4, 2}}) {
      const ContactReference reference = contact_reference(name, degree, refinements);
      if (reference.reaction == 0) continue;
      const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
      ASSERT_TRUE(result.estimates) << name;
      for (const estimation::GoalEstimate& goal : result.estimates->goals) {
        const double exact = (goal.name == "energy" ? reference.energy : reference.reaction) / reference.factor;
        const double ratio = goal.error() / std::abs(goal.value - exact);
        ++all;
        too_small += ratio < 0.3 ? 1 : 0;
        too_large += ratio > 15 ? 1 : 0;
        EXPECT_LT(goal.error(), 0.1 * std::abs(goal.value)) << name;
      }
    }
  EXPECT_EQ(all, 60);
  EXPECT_LE(too_small, all / 20);
  EXPECT_LE(too_large, all / 10);
}

/// Relative errors of the energy, on meshes that follow from it.
void expect_accuracy(problem::Problem problem, double exact, std::int64_t most_unknowns) {
  constexpr double tolerance = 1e-3;
  problem.discretisation.layers = problem::Layers::automatic;
  problem.accuracy = problem::Accuracy{.goals = {{"energy", tolerance}}, .max_unknowns = 1e5};
  if (!problem.shell.obstacles.empty()) problem.accuracy->goals.push_back({"reaction", tolerance});
  const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_NEAR(result.levels.back().energy / exact, 1, tolerance);
  EXPECT_LE(result.levels.back().unknowns, most_unknowns);
}

/// The last mesh changes hardly anything if the previous one nearly reached the accuracy.
TEST(Accuracy, OfACapTakesFewerUnknownsThanMeshesThatOvershoot) {
  const ContactReference cap = contact_reference("R4cap_e0.02_p0.002", 4, 0);
  expect_accuracy(cap.problem, cap.energy / cap.factor, 15000);
}

/// Errors of cells along a round edge of contact cancel. Their sum without signs would cost twice the unknowns.
TEST(Accuracy, OfARoundContactZoneIsNotTakenForTheSumOfAllItsCells) {
  const ContactReference plate = contact_reference("R3_e0.01_P0.5", 4, 0);
  expect_accuracy(plate.problem, plate.energy / plate.factor, 11000);
}

/// With rows of thin oblique cells at its edges. All have patches, at high degrees too, and none is divided for lack of one.
TEST(Accuracy, OfASaddleIsReachedAtAnyDegree) {
  for (const int degree : {4, 6}) {
    const LinearReference saddle = hyperbolic_paraboloid(1e-2, ShearCorrection::one, false, degree, 0);
    expect_accuracy(saddle.problem, *saddle.energy, 12000);
  }
}

}  // namespace
}  // namespace plastron::verification

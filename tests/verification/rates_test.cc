// Convergence rates against the manufactured solutions, uniformly in thickness, degree and tying.
#include "verification/error_norm.hpp"
#include "verification/figures.hpp"
#include "verification/reference_problems.hpp"

#include <plastron/computation/solve.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace plastron::verification::rates_test {
namespace {

const auto* const figures = testing::AddGlobalTestEnvironment(new EveryFigureIsHeld("verification_rates"));

struct Errors {
  std::vector<double> energy, l2;
};

/// Errors on successive refinements of four distorted cells. (On squares the exact solution lies in the space of
/// degree 4.)
Errors errors(const Manufactured& exact, int degree, bool tying, int first, int last,
              mesh::Shape cells = mesh::Shape::quadrilateral) {
  Errors e;
  for (int refinements = first; refinements <= last; ++refinements) {
    problem::Problem problem = manufactured_problem(exact, degree, refinements);
    problem.shell.tying = tying;
    problem.discretisation.cells = cells;
    problem.domain = domain::MeshFile{PLASTRON_MESH_DIR "/distorted-square.msh"};
    const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
    EXPECT_TRUE(is_solved_at_nodes(result)) << result.missed_limits;
    e.energy.push_back(energy_error(*result.solution, exact));
    e.l2.push_back(l2_error(*result.solution, exact));
  }
  return e;
}

using Parameters = std::tuple<int, double, bool>;
class Rate : public testing::TestWithParam<Parameters> {};
INSTANTIATE_TEST_SUITE_P(All, Rate,
                         testing::Combine(testing::Values(1, 2, 3, 4), testing::Values(1.0, 0.1, 0.01),
                                          testing::Bool()),
                         [](const auto& parameters) {
                           return fmt::format("degree{}_e{}_{}", std::get<0>(parameters.param),
                                              std::get<1>(parameters.param) == 1     ? "1"
                                              : std::get<1>(parameters.param) == 0.1 ? "01"
                                                                                     : "001",
                                              std::get<2>(parameters.param) ? "tied" : "plain");
                         });

TEST_P(Rate, TheEnergyErrorOfTheClampedSolutionFallsWithTheDegree) {
  const auto [degree, thickness, tying] = GetParam();
  const Manufactured exact(ManufacturedSolution::clamped, {.thickness = thickness});
  // Thin tied elements reach their rate from above, so finer meshes are needed to show it.
  const int last = (degree == 1 ? 5 : degree == 2 ? 4 : 3) + (thickness < 0.1 && tying ? (degree > 2 ? 2 : 1) : 0);
  const Errors e = errors(exact, degree, tying, last - 1, last);
  const double rate = rates(e.energy).back();
  RecordProperty("energy", fmt::format("{:.3e}", fmt::join(e.energy, " ")));
  RecordProperty("rate", fmt::format("{:.2f}", rate));
  EXPECT_NEAR(rate, degree, 0.15) << fmt::format("energy errors {:.3e}", fmt::join(e.energy, " "));
  EXPECT_GT(rates(e.l2).back(), degree + 0.25) << fmt::format("L2 errors {:.3e}", fmt::join(e.l2, " "));
}

// The distorted cells cut crosswise. At thickness 0.01 the error in L2 still shows locking on these meshes.
TEST(TriangleRate, TheEnergyErrorOfTheClampedSolutionFallsWithTheDegree) {
  for (const double thickness : {1.0, 0.1})
    for (int degree = 1; degree <= 2; ++degree) {
      const Manufactured exact(ManufacturedSolution::clamped, {.thickness = thickness});
      const int last = degree == 1 ? 5 : 4;
      const Errors e = errors(exact, degree, false, last - 1, last, mesh::Shape::triangle);
      expect_figure("rates, triangles", fmt::format("clamped, e = {:g}", thickness), fmt::format("degree {}", degree),
                    rates(e.energy));
      EXPECT_NEAR(rates(e.energy).back(), degree, 0.15)
          << fmt::format("energy errors {:.3e}", fmt::join(e.energy, " "));
      EXPECT_GT(rates(e.l2).back(), degree + 0.75) << fmt::format("L2 errors {:.3e}", fmt::join(e.l2, " "));
    }
}

// Contact at the vertices alone (M20) or at the middles of the edges alone: both bounds converge at the element's rate.
TEST(TriangleContactRate, TheSolutionWithAKnownFreeBoundaryConvergesWithTheDegree) {
  for (int degree = 1; degree <= 2; ++degree) {
    const Manufactured exact(ManufacturedSolution::contact, {.thickness = 0.1});
    const int last = degree == 1 ? 5 : 4;
    const Errors e = errors(exact, degree, false, last - 2, last, mesh::Shape::triangle);
    expect_figure("rates, triangles", "contact, e = 0.1", fmt::format("degree {}", degree), rates(e.energy));
    EXPECT_GT(std::log2(e.energy.front() / e.energy.back()) / 2, degree - 0.2);
  }
}

// With contact the free boundary, a curve inside the elements, limits the rate: the third derivative of u_3 jumps
// there. Up to degree 2 the full rate must show. Above, the rates found are in docs/verification.md.
TEST(ContactRate, TheSolutionWithAKnownFreeBoundaryConvergesUntilThatBoundaryLimitsIt) {
  for (const double thickness : {0.3, 0.1, 0.01})
    for (int degree = 1; degree <= 4; ++degree) {
      const Manufactured exact(ManufacturedSolution::contact, {.thickness = thickness});
      const int last = degree == 1 ? 5 : 4;
      const Errors e = errors(exact, degree, true, last - 2, last);
      const double mean = std::log2(e.energy.front() / e.energy.back()) / 2;
      expect_figure("rates, contact", fmt::format("{:g}", thickness), fmt::format("degree {}", degree),
                    rates(e.energy));
      EXPECT_GT(mean, std::min(degree, 2) - 0.2) << "e = " << thickness << ", degree " << degree;
    }
}

}  // namespace
}  // namespace plastron::verification::rates_test

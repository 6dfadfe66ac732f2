// The unknowns that start meshes with rows along the edges need for an error of 1e-3 (docs/methods/layers.md).
#include "verification/reference_problems.hpp"

#include <plastron/computation/solve.hpp>
#include <plastron/meshing/start_mesh.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace plastron::verification::layers_test {
namespace {

/// The saddle clamped on one edge, on its start mesh of the recommended degree.
problem::Problem saddle(double thickness) {
  problem::Problem p = hyperbolic_paraboloid(1e-3, ShearCorrection::one, false, 8, 0).problem;
  p.shell.sections.common.thickness = geometry::Expression(thickness);
  p.shell.loads.on_areas.front().force[2] = geometry::Expression(-8000 * thickness);
  p.domain = domain::Rectangle{.from = {-0.5, -0.5}, .to = {0.5, 0.5}};
  p.discretisation.layers = problem::Layers::automatic;
  p.discretisation.degree = meshing::recommended_degree(p);
  return p;
}

struct Saddle {
  double thickness;
  double deflection, energy;  ///< converged on graded meshes of degree 8, k_s = 1
  std::int64_t most_unknowns;
};

class SaddleOfThickness : public testing::TestWithParam<Saddle> {};
INSTANTIATE_TEST_SUITE_P(Of, SaddleOfThickness,
                         testing::Values(Saddle{1e-3, 6.39917e-3, 1.102284e-2, 8405},
                                         Saddle{1e-4, 0.53079, 0.090032, 21125}));

TEST_P(SaddleOfThickness, IsWithinOneThousandthOnItsStartMesh) {
  const auto [thickness, deflection, energy, most_unknowns] = GetParam();
  const computation::Result result = computation::solve(saddle(thickness), MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  EXPECT_NEAR(-result.probes.front().values.u[2] / deflection, 1, 1e-3);
  EXPECT_NEAR(result.summary.energy.total() / energy, 1, 1e-3);
  EXPECT_LE(result.levels.back().unknowns, most_unknowns);
}

/// 59 230 unknowns with one row along each edge.
TEST(StartMeshWithNarrowRows, TakesASaddleToOneTenThousandthWithFortyThousandUnknowns) {
  problem::Problem p = saddle(1e-3);
  p.discretisation.degree = 4;
  p.accuracy = problem::Accuracy{.goals = {{"probe.free end.u.z", 1e-4}}};
  const computation::Result result = computation::solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  EXPECT_NEAR(-result.probes.front().values.u[2] / 6.39917e-3, 1, 1e-4);
  EXPECT_LE(result.levels.back().unknowns, 40'000);
}

/// Joined cells brought their errors back and were divided again without end: meshes of 137 000 and 206 000 unknowns in turn.
TEST(AccuracyOfASaddle, IsReachedAtDegreeTwoAlthoughCellsThatJoinBringErrorsBack) {
  problem::Problem p = saddle(1e-2);
  p.discretisation.degree = 2;
  p.accuracy = problem::Accuracy{.goals = {{"energy", 1e-2}}, .max_unknowns = 190'000};
  const computation::Result result = computation::solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved);
  EXPECT_NEAR(result.summary.energy.total() / 1.68167e-3, 1, 1e-2);
}

TEST(StartMeshOfDegreeTwo, HasLessThanAThirdOfTheErrorOfEvenCells) {
  problem::Problem rows = saddle(1e-3);
  rows.discretisation.degree = 2;
  rows.discretisation.refinements = 3;
  problem::Problem plain = rows;
  plain.discretisation.layers = problem::Layers::none;
  plain.discretisation.refinements = 5;  // 33 x 33 nodes on the square make 21 125 unknowns
  const auto error = [](const problem::Problem& p, std::int64_t& unknowns) {
    const computation::Result result = computation::solve(p, MPI_COMM_WORLD);
    unknowns = result.levels.back().unknowns;
    return std::abs(result.summary.energy.total() / 1.102284e-2 - 1);
  };
  std::int64_t with_rows = 0, without = 0;
  EXPECT_LT(3 * error(rows, with_rows), error(plain, without));
  EXPECT_LE(with_rows, without);
}

/// Shells in contact begin with even cells, because the edge of the zone may lie anywhere in a cell.
TEST(StartMeshInContact, IsWithinOneThousandthOnACapAndAPlateWithFewerThanFourThousandUnknowns) {
  for (const char* name : {"R4cap_e0.02_p0.002", "R3_e0.01_P0.5"}) {
    ContactReference reference = contact_reference(name, 3, 0);
    reference.problem.discretisation.layers = problem::Layers::automatic;
    reference.problem.discretisation.degree = meshing::recommended_degree(reference.problem);
    const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
    ASSERT_EQ(result.status, contact::Status::solved) << name;
    EXPECT_NEAR(result.levels.back().energy / reference.energy, 1, 1e-3) << name;
    EXPECT_NEAR(result.levels.back().reaction / reference.reaction, 1, 1e-3) << name;
    EXPECT_LT(result.levels.back().unknowns, 4000) << name;
  }
}

}  // namespace
}  // namespace plastron::verification::layers_test

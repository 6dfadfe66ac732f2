// Solutions on graded meshes are as good as on uniform ones, for each formulation and number of ranks, with
// supports on curves with hanging nodes, contact zones across them, and recovered fields.
#include <gtest/gtest.h>
#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/computation/evaluation.hpp>
#include <plastron/computation/level.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/meshing/sequence.hpp>
#include <plastron/recovery/recovery.hpp>
#include <plastron/zones/contact_zones.hpp>

#include <cmath>
#include <functional>
#include <numbers>

#include "computation/problems.hpp"
#include "larger.hpp"

namespace plastron::computation {
namespace {

using namespace test;

using Place = Eigen::Vector2d;
/// Whether a cell with this middle is divided.
using Rule = std::function<bool(const Place&, int round)>;

Place middle_of(const fem::Space& space, std::size_t cell) {
  const fem::Cell& c = space.cells[cell];
  return space.coarse->cells[static_cast<std::size_t>(c.coarse)].map(c.corner + c.size * Place(0.5, 0.5)).value;
}

bool is_scattered(const Place& at, int round) {
  const auto number = static_cast<std::uint64_t>(std::llround(1e6 * at[0]) * 7919 + std::llround(1e6 * at[1]));
  return algebra::hash(number + static_cast<std::uint64_t>(round)) % 3 == 0;
}

LevelResult solve_graded(const problem::Problem& problem, const Rule& rule, int rounds,
                         MPI_Comm comm = MPI_COMM_WORLD) {
  fem::MeshSequence meshes = meshing::mesh_sequence(problem, comm);
  for (int i = 0; i < problem.discretisation.refinements; ++i) meshes.refine({});
  for (int round = 0; round < rounds; ++round) {
    std::vector<signed char> marks;
    for (std::size_t c = 0; c < meshes.space()->owned_cells; ++c)
      marks.push_back(rule(middle_of(*meshes.space(), c), round) ? 1 : 0);
    meshes.refine({}, marks);
  }
  EXPECT_FALSE(meshes.space()->continuity.is_identity());
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem.charts);
  const LevelTask task{.settings = problem.contact, .linearisation = problem.linearisation};
  return solve_level(task, assembly::discretise(meshes.space(), surface, problem.shell), {});
}

/// Covariant interpolation contains translations of curved shells only up to its order: `balance`.
void expect_certified(const LevelResult& level, double balance = 1e-9) {
  EXPECT_EQ(level.record.status, contact::Status::solved);
  const auto& c = level.verdict.certificate;
  EXPECT_LT(c.stationarity, 1e-9);
  EXPECT_LT(c.force_balance, balance);
  EXPECT_LT(std::abs(c.energy_identity), 1e-9);
  EXPECT_GE(c.min_gap_nodes, -1e-12);
}

/// Divided near the end of the contact.
bool at_zone_edge(const Place& at, int) { return std::abs(at.norm() - 0.2) < 0.06; }

class GradedShell : public testing::TestWithParam<element::Formulation> {};

TEST_P(GradedShell, IsAsGoodAsAUniformOne) {
  problem::Problem p = pressed_bowl();
  p.discretisation = {.degree = 2, .refinements = 2};
  p.shell.tangency = {.formulation = GetParam()};
  for (const Rule& rule : {Rule(at_zone_edge), Rule(is_scattered)}) {
    const LevelResult graded = solve_graded(p, rule, 2);
    expect_certified(graded, GetParam() == element::Formulation::classical ? 1e-5 : 1e-9);
    EXPECT_GT(graded.record.active, 0);
    problem::Problem finer = p;
    finer.discretisation.refinements = 4;
    const Result uniform = solve(finer, MPI_COMM_WORLD);
    EXPECT_LT(graded.record.unknowns, uniform.levels.back().unknowns);
    EXPECT_NEAR(graded.record.energy, uniform.levels.back().energy, 1e-2 * uniform.levels.back().energy);
    EXPECT_NEAR(graded.record.reaction, uniform.levels.back().reaction, 1e-2 * uniform.levels.back().reaction);
  }
}

TEST_P(GradedShell, IsTheSameOnAnyNumberOfRanks) {
  problem::Problem p = pressed_bowl();
  p.discretisation = {.degree = 3, .refinements = 1};
  p.shell.tangency = {.formulation = GetParam()};
  const LevelResult together = solve_graded(p, is_scattered, 2);
  const LevelResult alone = solve_graded(p, is_scattered, 2, MPI_COMM_SELF);
  EXPECT_EQ(together.record.unknowns, alone.record.unknowns);
  EXPECT_EQ(together.record.active, alone.record.active);
  EXPECT_NEAR(together.record.energy, alone.record.energy, 1e-10 * alone.record.energy);
  EXPECT_NEAR(together.record.reaction, alone.record.reaction, 1e-9 * alone.record.reaction);
}

INSTANTIATE_TEST_SUITE_P(Formulations, GradedShell,
                         testing::Values(element::Formulation::tangent, element::Formulation::penalised,
                                         element::Formulation::mixed, element::Formulation::classical),
                         [](const auto& each) { return std::string(element::to_string(each.param)); });

/// The inner curve of the file has cells of both regions at its sides. Whichever region is divided, all nodes of the curve are fixed.
TEST(GradedMesh, HoldsSupportsOnInnerCurves) {
  problem::Problem p = free_plate();
  p.domain = domain::MeshFile{PLASTRON_TESTS_DIR "/domain/data/two-regions-4.1.msh"};
  const mesh::CoarseMesh coarse = domain::coarse_mesh(p.domain, mesh::Shape::quadrilateral);
  p.charts.clear();
  for (const std::string& region : coarse.regions) p.charts.emplace(region, Chart({"x", "y", "0"}, {}));
  p.shell.supports = {clamped("junction")};
  p.shell.loads.on_areas = {force(0, 0, -1)};
  double at_curve = 0;  // x of the junction
  for (const mesh::BoundaryEdge& edge : coarse.edges)
    if (coarse.boundaries[static_cast<std::size_t>(edge.boundary)] == "junction")
      at_curve = coarse.vertices[static_cast<std::size_t>(edge.vertices[0])][0];
  for (const int degree : {1, 2, 3})
    for (const double side : {-1.0, 1.0}) {
      p.discretisation = {.degree = degree, .refinements = 1};
      const LevelResult level = solve_graded(
          p, [&](const Place& at, int) { return side * (at[0] - at_curve) > 0; }, 1);
      expect_certified(level);
      int seen = 0;
      for (std::size_t i = 0; i < level.solution.discrete->points.size(); ++i) {
        if (std::abs(level.solution.discrete->points[i].x[0] - at_curve) > 1e-9) continue;
        ++seen;
        for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(level.solution.nodal.y.local()[6 * i + k], 0, 1e-14);
      }
      EXPECT_GT(algebra::sum_over_ranks(std::int64_t{seen}, MPI_COMM_WORLD), 0);
      ASSERT_EQ(level.verdict.summary.support_reactions.size(), 1U);
      EXPECT_NEAR(level.verdict.summary.support_reactions[0].reaction.force[2], -level.verdict.summary.loads.force[2],
                  1e-9);
    }
}

/// A plate bent to constant curvature has constant moments on any mesh.
TEST(GradedMesh, GivesConstantResultantsExactly) {
  problem::Problem p = free_plate();
  p.shell.supports = {clamped("left")};
  energy::EdgeLoad bending{.boundary = "right"};
  bending.couple = vector(1, 0, 0);
  p.shell.loads.on_edges = {bending};
  p.shell.sections.common.material = shell::Material::from_young_poisson(1e4, 0, 1);
  p.discretisation = {.degree = 2, .refinements = 1};
  const LevelResult level = solve_graded(p, is_scattered, 3);
  expect_certified(level);
  const std::vector<Place> xi{{0.1, 0.2}, {0.5, 0.5}, {0.9, 0.7}};
  const auto patches =
      std::make_shared<const recovery::ResultantPatches>(*level.solution.discrete, level.solution.nodal);
  const recovery::Recovery recover(*level.solution.discrete, level.solution.nodal, xi, {.patches = patches});
  for (std::size_t c = 0; c < level.solution.discrete->space().owned_cells; ++c)
    for (const recovery::PointValues& point : recover(c)) {
      EXPECT_NEAR(std::abs(point.M[0]), 1, 1e-7);
      EXPECT_NEAR(point.M[1], 0, 1e-7);
      EXPECT_NEAR(point.M[2], 0, 1e-7);
    }
}

/// One zone with a closed boundary, although it crosses sides with hanging nodes.
TEST(GradedMesh, HasContactZonesWithClosedBoundaries) {
  problem::Problem p = pressed_bowl();
  p.discretisation = {.degree = 2, .refinements = 3};
  for (const Rule& rule : {Rule(at_zone_edge), Rule(is_scattered)}) {
    const LevelResult level = solve_graded(p, rule, 2);
    const auto zones = zones::contact_zones(*level.solution.discrete, level.solution.nodal).at(0);
    ASSERT_EQ(zones.size(), 1U);
    for (const solution::ContactLine& line : zones[0].lines) EXPECT_TRUE(line.is_closed) << line.points.size();
    EXPECT_NEAR(zones[0].lines[0].length, 2 * std::numbers::pi * 0.195, 0.03);
  }
}

}  // namespace
}  // namespace plastron::computation

// Given solutions: those of solve() pass, and any change makes a row fail.
#include <plastron/computation/solve.hpp>
#include <plastron/computation/verify.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <computation/problems.hpp>

#include <functional>

namespace plastron::computation {

namespace {

using namespace test;
using testing::Contains;
using testing::IsEmpty;

/// The rows that exceed their limits.
std::vector<std::string> failing(const Verification& v) {
  std::vector<std::string> rows;
  for (const auto* all : {&v.result.limits, &v.membership})
    for (const certificate::CertificateLimit& row : *all)
      if (!row.holds()) rows.emplace_back(row.row);
  return rows;
}

using Change = std::function<void(StoredSolution&, const assembly::DiscreteShell&)>;

/// Verifies the problem's solution after a change.
Verification verified(const problem::Problem& problem, const Change& change = {}) {
  Result result = solve(problem, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << status_text(result);
  StoredSolution solution{.state = result.solution->discrete->state, .nodal = result.solution->nodal};
  if (change) change(solution, *result.solution->discrete);
  return verify(problem, finest_mesh(problem, MPI_COMM_WORLD), std::move(solution));
}

problem::Problem with_formulation(element::Formulation formulation) {
  problem::Problem p = pressed_bowl();
  p.discretisation.refinements = 1;
  p.shell.tangency.formulation = formulation;
  return p;
}

/// A ball under the middle of a strip: the gap is linearised again.
problem::Problem strip_on_ball() {
  problem::Problem p = pressed_strip();
  p.discretisation.refinements = 1;
  p.shell.obstacles.all = {obstacle::Obstacle{.shape = obstacle::Ball{.centre = {0.5, 0.0625, -1}, .radius = 1}}};
  return p;
}

/// A change of one owned value of `node`, only on the rank that owns the most loaded node.
void nudge(algebra::Vector& field, std::size_t component, double by) {
  int rank = 0;
  MPI_Comm_rank(field.layout()->comm, &rank);
  const auto nodes = static_cast<std::size_t>(field.layout()->owned);
  if (rank == 0) field.owned()[(nodes / 2) * static_cast<std::size_t>(field.block()) + component] += by;
  field.update_ghosts();
}

TEST(Verification, PassesWhatWasSolved) {
  using element::Formulation;
  for (const Formulation f : {Formulation::tangent, Formulation::penalised, Formulation::mixed}) {
    const problem::Problem p = with_formulation(f);
    const Result result = solve(p, MPI_COMM_WORLD);
    const Verification v = verified(p);
    EXPECT_THAT(failing(v), IsEmpty()) << element::to_string(f);
    EXPECT_EQ(v.result.status, contact::Status::solved);
    EXPECT_NEAR(v.result.summary.energy.total(), result.summary.energy.total(), 1e-12 * result.summary.energy.total());
    EXPECT_EQ(v.result.levels.back().active, result.levels.back().active);
    EXPECT_GT(v.result.levels.back().active, 0);
  }
}

TEST(Verification, PassesTrianglesCovariantComponentsTwoFacesAndCurvedObstacles) {
  problem::Problem triangles = pressed_strip(), covariant = pressed_strip(), between = pressed_strip();
  triangles.discretisation.cells = mesh::Shape::triangle;
  covariant.shell.tangency.formulation = element::Formulation::classical;
  between.shell.obstacles.all = {
      obstacle::Obstacle{.name = "lower", .face = obstacle::Face::lower},
      obstacle::Obstacle{.name = "upper",
                         .shape = obstacle::HalfSpace{.point = {0, 0, 0.0601}, .normal = {0, 0, -1}},
                         .face = obstacle::Face::upper}};
  problem::Problem once = strip_on_ball();
  once.shell.obstacles.are_linear = true;
  for (const problem::Problem& p : {triangles, covariant, between, strip_on_ball(), once}) {
    const Verification v = verified(p);
    EXPECT_THAT(failing(v), IsEmpty());
    EXPECT_GT(v.result.levels.back().active, 0);
  }
}

TEST(Verification, FailsWhereADisplacementWasChanged) {
  const Verification v =
      verified(pressed_strip(), [](StoredSolution& s, const assembly::DiscreteShell&) { nudge(s.nodal.y, 2, 1e-5); });
  EXPECT_THAT(failing(v), Contains("stationarity"));
}

TEST(Verification, FailsWhereAReactionWasChanged) {
  const Verification v = verified(pressed_strip(), [](StoredSolution& s, const assembly::DiscreteShell&) {
    for (double& pressure : s.nodal.pressure.local()) pressure *= 1.001;
  });
  EXPECT_THAT(failing(v), Contains("stationarity"));
}

TEST(Verification, FailsWhereARotationIsNotTangent) {
  const Verification v =
      verified(pressed_strip(), [](StoredSolution& s, const assembly::DiscreteShell&) { nudge(s.nodal.y, 5, 1e-4); });
  EXPECT_THAT(failing(v), Contains("space_error"));
}

TEST(Verification, FailsWhereAnotherLoadWasCarried) {
  const auto tenfold = [](algebra::Vector& field) {
    for (double& value : field.local()) value *= 10;
  };
  problem::Problem p = cantilever_plate();  // linear: ten times the load gives ten times the displacement
  const Verification v = verified(p, [&](StoredSolution& s, const assembly::DiscreteShell&) {
    tenfold(s.nodal.y);
    s.state.factors.loads = 10;
  });
  EXPECT_THAT(failing(v), testing::ElementsAre("load_error"));
}

TEST(Verification, FailsWhereGapsAreLinearisedElsewhere) {
  const auto shifted = [](StoredSolution& s, const assembly::DiscreteShell& discrete) {
    if (!s.state.is_deformed()) s.state.displacement = algebra::Vector(discrete.space().layout, 6);
    for (std::size_t i = 0; i < s.state.displacement.local().size(); i += 6) s.state.displacement.local()[i] += 1e-3;
  };
  EXPECT_THAT(failing(verified(strip_on_ball(), shifted)), Contains("linearisation_error"));
  problem::Problem once = strip_on_ball();
  once.shell.obstacles.are_linear = true;
  EXPECT_THAT(failing(verified(once, shifted)), Contains("linearisation_error"));
}

TEST(Verification, FailsWhereTheMixedFormulationWasLeftWithoutItsConstraint) {
  // With p = rho = 1 the penalised solution solves the mixed equations with lambda = 0, except for b(U, q) = 0.
  problem::Problem penalised = with_formulation(element::Formulation::penalised);
  penalised.shell.tangency.penalty = penalised.shell.tangency.stabilisation = 1;
  problem::Problem mixed = penalised;
  mixed.shell.tangency.formulation = element::Formulation::mixed;
  Result result = solve(penalised, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  const FinestMesh mesh = finest_mesh(mixed, MPI_COMM_WORLD);
  StoredSolution solution{.state = {}, .nodal = std::move(result.solution->nodal)};
  solution.nodal.lambda = algebra::Vector(mesh.space->layout, 1);
  EXPECT_THAT(failing(verify(mixed, mesh, std::move(solution))), testing::ElementsAre("tangency_error"));
}

TEST(Verification, FailsWhereAnotherProblemIsSolved) {
  const problem::Problem solved = pressed_strip();
  const std::vector<std::pair<const char*, std::function<void(problem::Problem&)>>> others{
      {"load", [](problem::Problem& p) { p.shell.loads.on_areas = {force(0, 0, -4.01e-3)}; }},
      {"thickness", [](problem::Problem& p) { p.shell.sections.common.thickness = Expression(0.0501); }},
      {"supports",
       [](problem::Problem& p) {
         p.shell.supports.pop_back();
         p.shell.supports.push_back(clamped("top"));
       }},
      {"obstacle", [](problem::Problem& p) {
         p.shell.obstacles.all.front() =
             obstacle::Obstacle{.shape = obstacle::HalfSpace{.point = {0, 0, 1e-4}, .normal = {0, 0, 1}}};
       }}};
  Result result = solve(solved, MPI_COMM_WORLD);
  for (const auto& [what, change] : others) {
    problem::Problem other = solved;
    change(other);
    const Verification v = verify(other, finest_mesh(other, MPI_COMM_WORLD),
                                  {.state = result.solution->discrete->state, .nodal = result.solution->nodal});
    EXPECT_FALSE(failing(v).empty()) << what;
  }
}

}  // namespace

}  // namespace plastron::computation

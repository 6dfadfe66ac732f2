// admissible = true: the shell stays outside the obstacles between its nodes too. The cost falls with the mesh
// (docs/methods/admissible.md).
#include <plastron/certificate/gap_between.hpp>
#include <plastron/computation/bound_lifts.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/computation/verify.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <computation/problems.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace plastron::computation::admissible_test {
namespace {

using namespace test;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

obstacle::Obstacle waves(const std::string& height) {
  return {.shape = obstacle::HeightField(std::make_shared<const geometry::SpaceFunction>(height, Constants()))};
}

problem::Problem with(problem::Problem p, int degree, int refinements, mesh::Shape shape = mesh::Shape::quadrilateral) {
  p.discretisation.degree = degree;
  p.discretisation.refinements = refinements;
  p.discretisation.cells = shape;
  return p;
}

problem::Problem bowl(element::Formulation formulation) {
  problem::Problem p = with(pressed_bowl(), 2, 1);
  p.shell.tangency.formulation = formulation;
  return p;
}

/// A strip pressed on waves, or on a ball under its middle. Gaps are linearised again.
problem::Problem on_waves() {
  problem::Problem p = pressed_strip();
  p.shell.obstacles.all = {waves("0.004 * sin(9 * X) * cos(4 * Y) - 0.004")};
  return p;
}

problem::Problem on_ball() {
  problem::Problem p = pressed_strip();
  p.shell.obstacles.all = {obstacle::Obstacle{.shape = obstacle::Ball{.centre = {0.5, 0.0625, -1}, .radius = 1}}};
  return p;
}

/// A wavy strip. Its lower face lies on a floor and its upper face on a ceiling.
problem::Problem between_planes() {
  problem::Problem p = with_chart(pressed_strip(), {"x", "y", "0.09 + 0.03*sin(2*pi*x)"});
  p.shell.sections.common.thickness = Expression(0.1);
  p.shell.loads.on_areas = {
      energy::AreaLoad{.force = {Expression(0.0), Expression(0.0), Expression("0.05*sin(2*pi*x)", {})}}};
  p.shell.obstacles.all = {{.name = "floor"},
                           {.name = "ceiling",
                            .shape = obstacle::HalfSpace{.point = {0, 0, 0.175}, .normal = {0, 0, -1}},
                            .face = obstacle::Face::upper}};
  return p;
}

/// A force presses a ball on the strip, which has no other load.
problem::Problem under_pressed_ball() {
  problem::Problem p = pressed_strip();
  p.shell.loads.on_areas.clear();
  p.shell.obstacles.all = {obstacle::Obstacle{
      .name = "ball", .shape = obstacle::Ball{.centre = {0.5, 0.0625, 0.37}, .radius = 0.3}, .force = {0, 0, -2e-5}}};
  return p;
}

/// The ball comes down in two parts of a step.
problem::Problem in_steps() {
  problem::Problem p = on_ball();
  p.shell.obstacles.all[0].motions = {obstacle::Motion{.translation = {0, 0, 0.002}}};
  p.steps = {{.name = "lift", .factors = {.loads = 1}, .parts = 2}};
  return p;
}

/// A cantilever over an obstacle whose top touches its lower face.
problem::Problem cantilever(const obstacle::Obstacle& obstacle, int degree, int cells, element::Rotations rotations) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "0"}, {});
  p.domain = domain::Rectangle{.to = {100, 10}, .cells = {cells, 1}};
  p.shell.sections.common.thickness = Expression(2.0);
  p.shell.sections.common.material = shell::Material::from_young_poisson(2e5, 0, 1);
  p.shell.rotations = rotations;
  p.shell.supports = {clamped("left")};
  p.shell.loads.on_areas = {energy::AreaLoad{.force = {Expression(0.0), Expression(0.0), Expression(-0.01)}}};
  p.shell.obstacles.all = {obstacle};
  return with(p, degree, 0);
}

obstacle::Obstacle roller(double radius) {
  return {.shape = obstacle::Cylinder{.point = {47.3, 0, -1 - radius}, .axis = {0, 1, 0}, .radius = radius}};
}
obstacle::Obstacle table() { return {.shape = obstacle::Box{.centre = {47.3, 5, -6}, .size = {11.1, 40, 10}}}; }

struct Named {
  const char* name;
  problem::Problem problem;
};

std::vector<Named> problems() {
  using element::Formulation;
  constexpr auto triangle = mesh::Shape::triangle;
  return {{"bowl, degree 1", with(pressed_bowl(), 1, 2)},
          {"bowl, degree 2", with(pressed_bowl(), 2, 1)},
          {"bowl, degree 4", with(pressed_bowl(), 4, 1)},
          {"bowl, degree 8", with(pressed_bowl(), 8, 0)},
          {"bowl, triangles of degree 1", with(pressed_bowl(), 1, 2, triangle)},
          {"bowl, triangles of degree 2", with(pressed_bowl(), 2, 1, triangle)},
          {"bowl, penalised", bowl(Formulation::penalised)},
          {"bowl, mixed", bowl(Formulation::mixed)},
          {"bowl, classical", bowl(Formulation::classical)},
          {"waves, degree 1", with(on_waves(), 1, 1)},
          {"waves, degree 2", with(on_waves(), 2, 1)},
          {"ball, degree 2", with(on_ball(), 2, 1)},
          {"ball, triangles of degree 2", with(on_ball(), 2, 1, triangle)},
          {"between planes", with(between_planes(), 2, 1)},
          {"under a pressed ball", with(under_pressed_ball(), 2, 1)},
          {"in steps", with(in_steps(), 2, 1)}};
}

Result solved(problem::Problem p, bool admissible, MPI_Comm comm = MPI_COMM_WORLD) {
  p.admissible = admissible;
  return solve(p, comm);
}

/// Depth of the faces in their obstacles, from gaps linearised at the deformed shell: true distances.
double depth(const Result& r, int intervals) {
  assembly::DiscreteShell& discrete = *r.solution->discrete;
  const assembly::State state = discrete.state;
  assembly::State moved = state;
  moved.displacement = r.solution->nodal.y;
  moved.positions = discrete.positions();
  linearise(discrete, moved);
  const double depth = -certificate::min_gap_on_lattice(discrete, r.solution->nodal.y, intervals);
  linearise(discrete, state);
  return depth;
}

double length_of(const Result& r) { return std::max(r.summary.least_thickness, r.summary.max_displacement); }

/// 1/2 a(U, U) - l(U) of the finest mesh [J].
double potential(const Result& r) { return r.summary.energy.total() + r.summary.tangency_energy - r.summary.load_work; }

StoredSolution stored(const Result& r) {
  const assembly::DiscreteShell& discrete = *r.solution->discrete;
  StoredSolution solution{.state = discrete.state, .nodal = r.solution->nodal};
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) solution.ways.push_back(discrete.way_pressed(k));
  return solution;
}

/// The rows that exceed their limits.
std::vector<std::string> failing(problem::Problem problem, StoredSolution solution) {
  problem.admissible = true;
  const Verification v = verify(problem, finest_mesh(problem, MPI_COMM_WORLD), std::move(solution));
  std::vector<std::string> rows;
  for (const auto* all : {&v.result.limits, &v.membership})
    for (const certificate::CertificateLimit& row : *all)
      if (!row.holds()) rows.emplace_back(row.row);
  return rows;
}

TEST(AdmissibleSolution, IsOutOfTheObstaclesBetweenItsNodesAndIsVerified) {
  for (const auto& [name, problem] : problems()) {
    SCOPED_TRACE(name);
    const Result without = solved(problem, false), lifted = solved(problem, true);
    EXPECT_EQ(lifted.status, contact::Status::solved) << status_text(lifted);
    const double length = length_of(lifted);
    const int k = problem.discretisation.degree;
    EXPECT_GT(depth(without, 4 * k), 1e-5 * length) << "there was nothing to do";
    EXPECT_LE(depth(lifted, std::max(8, 4 * k)), 1e-7 * length);  // gaps in contact are linearised again to 1e-8
    EXPECT_LE(depth(lifted, 48), 1e-4 * depth(without, 48));
    EXPECT_GE(lifted.certificate.min_gap_between, -1e-9 * length);
    EXPECT_GT(lifted.summary.touching_nodes, 0);
    EXPECT_GT(lifted.summary.largest_lift, 0);
    EXPECT_LT(lifted.summary.largest_lift, 4 * largest_dip(*lifted.solution->discrete, lifted.solution->nodal.y));
    EXPECT_THAT(failing(problem, stored(lifted)), IsEmpty());
  }
}

// Nothing else in the estimates shows lifts: the same mesh without them has other numbers, and either may be nearer to the exact ones.
TEST(AdmissibleSolution, HasErrorsThatContainTheChangeByItsLifts) {
  std::vector<Named> all = problems();
  for (problem::Problem p : {with(pressed_bowl(), 2, 1), with(on_ball(), 2, 1)}) {
    p.shell.rotations = element::Rotations::finite;
    all.push_back({"finite rotations", p});
  }
  for (const auto& [name, problem] : all) {
    const Result without = solved(problem, false), lifted = solved(problem, true);
    ASSERT_TRUE(without.estimates && lifted.estimates) << name;
    for (std::size_t g = 0; g < lifted.estimates->goals.size(); ++g) {
      const estimation::GoalEstimate &before = without.estimates->goals[g], &goal = lifted.estimates->goals[g];
      const double change = std::abs(goal.value - before.value);
      if (change < 1e-9 * goal.value) continue;  // a given force alone is the reaction
      EXPECT_GT(goal.error(), change / 2) << name << ": " << goal.name;
      EXPECT_LT(goal.error(), 4 * (change + before.error())) << name << ": " << goal.name;
    }
  }
}

TEST(AdmissibleSolution, NamesLiftsThatChangeMuchOfTheEnergy) {
  int named = 0, all = 0;
  std::vector<Named> cases = problems();
  cases.push_back({"roller", cantilever(roller(2), 4, 9, element::Rotations::small)});
  for (auto& [name, problem] : cases) {
    problem.discretisation.refinements = 0;
    const Result lifted = solved(problem, true);
    if (lifted.status != contact::Status::solved) continue;
    const Level& level = lifted.last_level();
    const bool is_much = std::abs(level.energy - level.energy_before_lifts) >
                         0.1 * std::max(std::abs(level.energy), std::abs(level.energy_before_lifts));
    const auto warning = HasSubstr("admissible = true lifts bounds");
    EXPECT_EQ(std::ranges::any_of(lifted.warnings, [&](const auto& w) { return testing::Value(w, warning); }), is_much)
        << name;
    named += is_much ? 1 : 0;
    ++all;
  }
  EXPECT_GT(named, 0);
  EXPECT_LT(named, all);
}

/// The largest distance between the nodes of two solutions on the same mesh [m].
double distance(const Result& a, const Result& b) {
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.solution->discrete->space().layout->owned); ++i)
    most =
        std::max(most, (assembly::node_values(a.solution->nodal.y, i) - assembly::node_values(b.solution->nodal.y, i))
                           .head<3>()
                           .norm());
  return most;
}

// Gaps to narrow obstacles have kinks and wide ranges in a cell: neither is a depth.
TEST(AdmissibleSolution, DiffersFromThePlainOneByTheOrderOfItsDepth) {
  using element::Rotations;
  int solutions = 0;
  for (const auto& [name, obstacle] : {std::pair{"wire", roller(0.2)}, std::pair{"roller", roller(2)},
                                       std::pair{"drum", roller(20)}, std::pair{"table", table()}})
    for (const auto& [degree, cells] : {std::pair{1, 36}, std::pair{2, 9}, std::pair{2, 18}, std::pair{4, 9}})
      for (const Rotations rotations : {Rotations::small, Rotations::finite}) {
        if (rotations == Rotations::finite && degree == 1) continue;
        SCOPED_TRACE(fmt::format("{}, degree {}, {} cells, {}", name, degree, cells,
                                 rotations == Rotations::finite ? "finite" : "small"));
        problem::Problem p = cantilever(obstacle, degree, cells, rotations);
        const Result plain = solved(p, false), lifted = solved(p, true);
        EXPECT_EQ(lifted.status == contact::Status::solved, failing(p, stored(lifted)).empty());
        if (plain.status != contact::Status::solved || lifted.status != contact::Status::solved) continue;
        const double depth = std::max(0.0, -plain.certificate.min_gap_between);
        EXPECT_LE(distance(plain, lifted), 5 * depth + 2e-3 * plain.summary.max_displacement);
        EXPECT_LE(lifted.summary.largest_lift, 2 * depth + 1e-3 * plain.summary.max_displacement);
        ++solutions;
      }
  EXPECT_GE(solutions, 20);
}

TEST(AdmissibleSolution, IsTooCoarseWhereNodesDoNotSeeTheObstacle) {
  const Result lifted = solved(cantilever(roller(0.2), 4, 9, element::Rotations::small), true);
  EXPECT_EQ(lifted.status, contact::Status::inaccurate);
  EXPECT_THAT(lifted.missed_limits, HasSubstr("the mesh is too coarse"));
}

TEST(AdmissibleSolution, CarriesTheForceOfAPressedObstacleWithFiniteRotations) {
  problem::Problem p = with(under_pressed_ball(), 2, 1);
  p.shell.rotations = element::Rotations::finite;
  p.shell.obstacles.all[0].shape = obstacle::Ball{.centre = {0.47, 0.055, 0.17}, .radius = 0.1};
  const Result lifted = solved(p, true);
  EXPECT_EQ(lifted.status, contact::Status::solved) << status_text(lifted);
  EXPECT_GT(lifted.summary.largest_lift, 0);
  EXPECT_NEAR(lifted.summary.reaction.force[2], -2e-5, 2e-11);
  EXPECT_THAT(failing(p, stored(lifted)), IsEmpty());
}

TEST(AdmissibleSolution, CostsNoMoreThanTheLiftWorkSays) {
  for (const problem::Problem& problem : {with(pressed_bowl(), 1, 2), with(pressed_bowl(), 2, 2),
                                          with(between_planes(), 2, 1), bowl(element::Formulation::mixed)}) {
    const Result without = solved(problem, false), lifted = solved(problem, true);
    const double cost = potential(lifted) - potential(without);
    EXPECT_GT(cost, 0);
    EXPECT_LT(cost, lifted.summary.lift_work);
    EXPECT_LT(lifted.summary.lift_work, 3 * cost);
    const Level& level = lifted.levels.back();
    EXPECT_NEAR(level.energy_before_lifts / without.summary.energy.total(), 1, level.lift_rounds > 0 ? 1e-2 : 0);
  }
}

/// Rates of the cost from mesh to mesh.
std::vector<double> rates(int degree, mesh::Shape shape) {
  std::vector<double> costs, all;
  for (const int refinements : {1, 2, 3}) {
    const problem::Problem p = with(pressed_bowl(), degree, refinements, shape);
    const Result without = solved(p, false), lifted = solved(p, true);
    costs.push_back((potential(lifted) - potential(without)) / without.summary.energy.total());
    fmt::print("degree {}, {} refinements: cost {:.3e}, lift {:.3e}, lift work {:.3e}, rounds {}\n", degree,
               refinements, costs.back(), lifted.summary.largest_lift,
               lifted.summary.lift_work / without.summary.energy.total(), lifted.levels.back().lift_rounds);
  }
  for (std::size_t i = 1; i < costs.size(); ++i) all.push_back(std::log2(costs[i - 1] / costs[i]));
  return all;
}

TEST(AdmissibleSolution, CostsOfTheOrderOfTheElements) {
  for (const auto shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle}) {
    EXPECT_THAT(rates(1, shape), testing::Each(testing::Gt(1.8)));
    EXPECT_THAT(rates(2, shape), testing::Each(testing::Gt(2.4)));
  }
}

TEST(AdmissibleSolution, IsTheSameToTheLastDigitWhereTheShellIsOutAnyway) {
  const problem::Problem flat = with(pressed_strip(), 1, 2);
  const Result without = solved(flat, false), lifted = solved(flat, true);
  EXPECT_GT(without.summary.touching_nodes, 0);
  EXPECT_EQ(lifted.levels.back().lift_rounds, 0);
  EXPECT_EQ(lifted.levels.back().energy_before_lifts, lifted.levels.back().energy);
  const auto a = without.solution->nodal.y.owned(), b = lifted.solution->nodal.y.owned();
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}

TEST(AdmissibleSolution, IsTheSameOnEveryNumberOfRanks) {
  for (const auto& [name, problem] : problems()) {
    if (problem.discretisation.degree != 2) continue;
    SCOPED_TRACE(name);
    const Result all = solved(problem, true), one = solved(problem, true, MPI_COMM_SELF);
    EXPECT_EQ(all.last_level().lift_rounds, one.last_level().lift_rounds);
    EXPECT_EQ(all.summary.touching_nodes, one.summary.touching_nodes);
    EXPECT_NEAR(all.summary.energy.total() / one.summary.energy.total(), 1, 1e-9);
    EXPECT_NEAR(all.summary.largest_lift / one.summary.largest_lift, 1, 1e-7);
    EXPECT_NEAR(all.summary.lift_work / one.summary.lift_work, 1, 1e-7);
  }
}

TEST(AdmissibleSolution, IsNotClaimedWhereASupportHoldsTheShellInsideBetweenNodes) {
  problem::Problem p = with(pressed_strip(), 1, 1);  // nodes of the clamped end at y = 0, 1/16, 1/8
  p.shell.obstacles.all = {waves("0.014 * exp(-(X^2 + (Y - 1/32)^2) / 0.0002)")};
  const Result without = solved(p, false), lifted = solved(p, true);
  EXPECT_EQ(without.status, contact::Status::solved) << status_text(without);
  EXPECT_EQ(lifted.status, contact::Status::inaccurate);
  EXPECT_THAT(lifted.missed_limits, HasSubstr("min_gap_between"));
}

TEST(AdmissibleSolution, WithOtherLiftsIsNotVerified) {
  const problem::Problem p = with(pressed_bowl(), 2, 1);
  const Result lifted = solved(p, true);
  const auto changed = [&](double factor) {
    StoredSolution solution = stored(lifted);
    for (double& lift : solution.state.lifts.local()) lift *= factor;
    return failing(p, std::move(solution));
  };
  EXPECT_THAT(changed(1), IsEmpty());
  EXPECT_THAT(changed(1.01), Contains("complementarity"));
  EXPECT_THAT(changed(0), Contains("complementarity"));
  EXPECT_THAT(changed(-1), Contains("least_lift"));
  EXPECT_THAT(changed(20), Contains("largest_lift"));
}

}  // namespace
}  // namespace plastron::computation::admissible_test

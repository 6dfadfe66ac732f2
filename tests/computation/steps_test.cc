// Steps: loads and obstacles change, and each instant starts from the previous one.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/problem/instants.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;

/// A clamped square plate 0.007 above a table; its load presses it on the table. Beside its middle is a ball, 0.005 above it.
problem::Problem plate() {
  problem::Problem p;
  p.domain = domain::Rectangle{.from = {-0.5, -0.5}, .to = {0.5, 0.5}, .cells = {2, 2}};
  p.charts = {{"", Chart({"x", "y", "0"}, {})}};
  p.shell.sections.common.thickness = Expression(0.05);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.supports = {clamped("left"), clamped("right"), clamped("bottom"), clamped("top")};
  p.shell.loads.on_areas = {force(0, 0, -1.2e-4)};
  p.shell.obstacles.all = {{.name = "table", .shape = obstacle::HalfSpace{.point = {0, 0, -0.032}}},
                           {.name = "ball", .shape = obstacle::Ball{.centre = {0.25, 0, 0.33}, .radius = 0.3}}};
  p.discretisation = {.degree = 2, .refinements = 2};
  return p;
}

obstacle::Motion down(double way) { return {.translation = {0, 0, -way}}; }

TEST(Instants, GoInEqualPartsFromWhatWasToWhatTheStepSays) {
  problem::Problem p = plate();
  EXPECT_EQ(problem::instants(p).size(), 1U);
  EXPECT_EQ(problem::instants(p)[0].factors.time, 0);
  EXPECT_EQ(problem::instants(p)[0].factors.loads, 1);
  p.steps = {{.name = "a", .factors = {.loads = 1}, .parts = 2}, {.name = "b", .factors = {.loads = 4}, .parts = 3}};
  const auto all = problem::instants(p);
  ASSERT_EQ(all.size(), 5U);
  const std::vector<double> times{0.5, 1, 1 + 1.0 / 3, 1 + 2.0 / 3, 2}, factors{0.5, 1, 2, 3, 4};
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(all[i].factors.time, times[i], 1e-15);
    EXPECT_NEAR(all[i].factors.loads, factors[i], 1e-15);
  }
}

// Values of supports and rigid bodies change like loads; the linear shell follows in proportion.
TEST(PrescribedComponents, ChangeInTheParts) {
  for (const bool by_body : {false, true}) {
    problem::Problem p = free_plate();
    p.shell.supports = {clamped("left")};
    if (by_body)
      p.rigid_bodies.push_back(
          {.name = "end", .boundaries = {"right"}, .reference = {1, 0, 0}, .fixed = {0.0, 0.0, 0.1, 0.0, 0.2, 0.0}});
    else
      p.shell.supports.push_back(
          {.boundary = "right",
           .components = {fixed(assembly::Unknown::displacement, assembly::Direction::z, Expression(0.1))}});
    p.discretisation = {.degree = 2, .refinements = 1};
    p.steps = {{.name = "lift", .parts = 2}, {.name = "down", .factors = {.supports = -0.25}}};
    const Result r = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    const std::vector<double> factors{0.5, 1, -0.25};
    for (std::size_t i = 0; i < factors.size(); ++i) {
      EXPECT_EQ(r.history[i].factors.supports, factors[i]);
      EXPECT_NEAR(r.history[i].summary.max_displacement / r.history[1].summary.max_displacement, std::abs(factors[i]),
                  1e-9);
      EXPECT_NEAR(r.history[i].summary.energy.total() / r.history[1].summary.energy.total(), factors[i] * factors[i],
                  1e-9);
      if (by_body) {
        EXPECT_NEAR(r.history[i].summary.body_reactions[0].rotation[1], 0.2 * factors[i], 1e-12);
      }
    }
  }
}

TEST(TheEndOfTheSteps, IsWhatOneStepGives) {
  problem::Problem many = plate(), one = plate();
  many.steps = {{.name = "weight", .factors = {.loads = 1}, .parts = 2},
                {.name = "press", .factors = {.loads = 1}, .parts = 3}};
  many.shell.obstacles.all[0].motions = {obstacle::Motion{}, obstacle::Motion{}};
  many.shell.obstacles.all[1].motions = {obstacle::Motion{}, down(0.0115)};
  one.shell.obstacles.all[1].placement.translation = {0, 0, -0.0115};
  const Result a = solve(many, MPI_COMM_WORLD), b = solve(one, MPI_COMM_WORLD);
  ASSERT_EQ(a.status, contact::Status::solved);
  ASSERT_EQ(a.history.size(), 5U);
  EXPECT_TRUE(b.history.empty());
  EXPECT_NEAR(a.summary.energy.total() / b.summary.energy.total(), 1, 1e-9);
  for (int k : {0, 1}) {
    const auto &x = a.summary.obstacles.at(k), &y = b.summary.obstacles.at(k);
    EXPECT_NEAR(x.reaction.force[2], y.reaction.force[2],
                3e-8 * b.summary.reaction.force.norm());  // 1.16e-8 with AVX-512 and sanitizers
    EXPECT_EQ(x.nodes, y.nodes);
  }
  EXPECT_GT(a.summary.obstacles.at(1).nodes, 0);
  EXPECT_NEAR(a.summary.obstacles.at(1).translation[2], -0.0115, 1e-15);
  EXPECT_EQ(a.history.back().step, "press");
  EXPECT_EQ(a.history.back().factors.time, 2);
  EXPECT_EQ(a.history[0].factors.loads, 0.5);
  EXPECT_NEAR(a.history[0].summary.loads.force[2], -0.6e-4, 1e-16);
}

TEST(ForceOverWay, IsMonotoneAndComesBackTheSameWay) {
  problem::Problem p = plate();
  p.shell.loads.on_areas.clear();
  p.shell.obstacles.all.erase(p.shell.obstacles.all.begin());
  p.steps = {{.name = "press", .parts = 4}, {.name = "release", .parts = 4}};
  p.shell.obstacles.all[0].motions = {down(0.012), down(-0.012)};
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved);
  ASSERT_EQ(r.history.size(), 8U);
  const auto force = [&](std::size_t i) { return r.history[i].summary.obstacles.at(0).reaction.force.norm(); };
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(force(i), force(i - 1));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(force(6 - i), force(i), 1e-8 * force(3));  // no friction, no memory
  EXPECT_EQ(force(7), 0);
}

// The zone grows by several rows of nodes in each part. Extrapolated roots of gaps predict all but a few nodes. The
// open nodes need no other factor.
TEST(AStep, TakesOneFactorisationForEachOfItsPartsAndFewActiveSets) {
  problem::Problem p = plate();
  p.shell.obstacles.all.erase(p.shell.obstacles.all.begin() + 1);
  p.discretisation = {.degree = 2, .refinements = 4};
  p.steps = {{.name = "press", .factors = {.loads = 4}, .parts = 12}};
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved);
  ASSERT_EQ(r.history.size(), 12U);
  int sets = 0;
  for (std::size_t i = 6; i < 12; ++i) {
    const Level& level = r.history[i].level;
    EXPECT_GE(level.active, r.history[i - 1].level.active + 16);
    sets += level.iterations;
    if (r.ranks == 1) {
      EXPECT_EQ(level.factorisations, 1);
    }
  }
  EXPECT_LE(sets, 14);
}

TEST(TheObserver, HearsOfEveryInstantWithItsSolution) {
  problem::Problem p = plate();
  p.steps = {{.name = "press", .parts = 3}};
  std::vector<double> times;
  const Result r = solve(p, MPI_COMM_WORLD, {.instant = [&](const HistoryEntry& entry, const Solution& solution) {
                           times.push_back(entry.factors.time);
                           EXPECT_EQ(solution.discrete->state.factors.time, entry.factors.time);
                         }});
  ASSERT_EQ(times.size(), 3U);
  EXPECT_EQ(times.back(), 1);
}

TEST(Steps, EndWhereOneIsNotSolved) {
  problem::Problem p = plate();
  p.steps = {{.name = "press", .parts = 1}, {.name = "through the rim", .parts = 2}};
  p.shell.obstacles.all[0].motions = {obstacle::Motion{}, down(-0.01)};  // the table enters the clamped edge
  const Result r = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(r.status, contact::Status::infeasible);
  EXPECT_EQ(r.history.size(), 3U);
  EXPECT_EQ(r.history[1].status, contact::Status::solved);
}

// A hinged strip is pushed together under a wall. Its flat part, which an imperfection of 4 % of the thickness lays on the wall, buckles
// away from it between 1.0 and 1.1 mm. The energies are those of 96 cells of degree 4 with 30 parts of 3 mm. Fine meshes stayed flat.
/// A strip between hinges that are pushed together; it bends, lies on a wall and buckles away from it.
problem::Problem strip_under_a_wall(int cells, double push, int parts) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "0.02*sin(pi*x/100)"}, {});
  p.domain = domain::Rectangle{.to = {100, 10}, .cells = {cells, 1}};
  p.shell.sections.common.thickness = Expression(0.5);
  p.shell.sections.common.material = shell::Material::from_young_poisson(70000, 0, 1);
  p.shell.rotations = element::Rotations::finite;
  p.shell.supports = {held("left", {Direction::x, Direction::y, Direction::z}),
                      held("right", {Direction::x, Direction::y, Direction::z})};
  p.shell.supports[1].components[0].value = Expression(-push);
  p.shell.obstacles.all = {{.name = "wall", .shape = obstacle::HalfSpace{.point = {0, 0, 4.25}, .normal = {0, 0, -1}}}};
  p.discretisation = {.degree = 3, .refinements = 0};
  p.steps = {{.name = "push", .parts = parts}};
  return p;
}

TEST(IdleContact, DoesNotHoldAStripThatBucklesAwayFromIt) {
  for (const int cells : {24, 64}) {
    const Result result = solve(strip_under_a_wall(cells, 1.25, 5), MPI_COMM_WORLD);
    ASSERT_EQ(result.status, contact::Status::solved) << cells;
    EXPECT_NEAR(result.history[3].summary.energy.total(), 38.569, 0.01) << cells;  // flat
    EXPECT_NEAR(result.summary.energy.total(), 62.3, 0.1) << cells;                // 73.5 flat
  }
}

// The narrow cells at the edges of the flat zone had motions of less energy than the shape to which the strip snaps.
TEST(IdleContact, IsLeftOnMeshesThatFollowTheShell) {
  problem::Problem p = strip_under_a_wall(16, 1.3, 13);
  p.discretisation.degree = 4;
  p.accuracy = problem::Accuracy{.goals = {{"energy", 1e-2}, {"reaction", 1e-2}}};
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_NEAR(result.summary.energy.total(), 66.729, 0.02);
  EXPECT_NEAR(result.history[11].summary.energy.total(), 57.863, 0.02);
}

// A part could end on an equilibrium that is not stable, at which the shell bends to one side: the way goes on where the shell snaps to.
TEST(ChosenParts, GoOnWhereAShallowArchSnapsTo) {
  std::mt19937 random(4);
  for (int i = 0; i < 4; ++i) {
    const double L = std::array{1.0, 1e-3, 1e3, 1.0}[static_cast<std::size_t>(i)];
    const double modulus = std::uniform_real_distribution<double>(0.8, 2)(random);
    problem::Problem p = with_chart(free_plate(), {"x", "y", fmt::format("{}*(1 - (2*x/{} - 1)^2)", 0.08 * L, L)}, {});
    p.domain = domain::Rectangle{.to = {L, 0.2 * L}, .cells = {8, 1}};
    p.shell.sections.common.thickness = Expression(0.02 * L);
    const shell::Layer layer{.material = shell::Orthotropic::isotropic(modulus, 0.3)};
    p.shell.sections.common.material = i == 3
                                           ? shell::Material{std::make_shared<const shell::Laminate>(
                                                                 std::vector{layer, layer}, Eigen::Vector3d(1, 0, 0)),
                                                             1}
                                           : shell::Material::from_young_poisson(modulus, 0.3, 1);
    p.shell.rotations = element::Rotations::finite;
    const auto end = [&](const std::string& name) {
      return i % 2 == 0 ? held(name, {Direction::x, Direction::y, Direction::z}) : clamped(name);
    };
    p.shell.supports = {end("left"), end("right"), symmetry("bottom")};
    p.shell.loads.on_areas = {force(0, 0, -1e-4)};
    p.discretisation = {.degree = 3, .refinements = 0};
    p.steps = {{.name = "load", .parts = 8}};
    const Result given = solve(p, MPI_COMM_WORLD);
    p.steps = {{.name = "load", .chooses_parts = true}};
    const Result chosen = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(given.status, contact::Status::solved) << modulus << " " << L;
    ASSERT_EQ(chosen.status, contact::Status::solved) << modulus << " " << L;
    EXPECT_TRUE(std::ranges::any_of(chosen.history, [](const HistoryEntry& entry) { return entry.level.has_jumped; }));
    EXPECT_NEAR(chosen.summary.energy.total() / given.summary.energy.total(), 1, 1e-6) << modulus << " " << L;
  }
}

}  // namespace
}  // namespace plastron::computation

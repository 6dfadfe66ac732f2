// Shells with finite rotations (M23-M29), stability, buckling loads and natural frequencies (M30), against closed forms and limits.
#include <plastron/computation/solve.hpp>
#include <plastron/computation/warnings.hpp>
#include <plastron/examination/examine.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "computation/finite_scenes.hpp"

namespace plastron::computation {
namespace {

using namespace test;

using testing::Contains;
using testing::HasSubstr;

// A prescribed end director rolls a strip up: d turns evenly, and the stretch lambda takes the axial force of the curvature out,
// lambda^2 = 1 - (e kappa)^2 / 6. For u free and nu = 0 this solves (M23-M27) exactly.
problem::Problem rolled_strip(double e, double theta) {
  problem::Problem p = strip_of({"x", "y", "0"}, e, 1, 0);
  p.shell.rotations = element::Rotations::finite;
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0, 1);
  p.shell.supports.push_back(clamped("left"));
  Support end{.boundary = "right", .components = {}};
  const auto r = vector(-std::sin(theta), 0, std::cos(theta) - 1);
  for (const auto& [direction, value] :
       {std::pair(Direction::x, r[0]), std::pair(Direction::y, r[1]), std::pair(Direction::z, r[2])})
    end.components.push_back(fixed(Unknown::rotation, direction, value));
  p.shell.supports.push_back(end);
  return p;
}

double energy_of_rolled_strip(double e, double kappa) {
  const double lambda2 = 1 - std::pow(e * kappa, 2) / 6;
  return 0.1 / 2 * (e * std::pow(std::pow(e * kappa, 2) / 12, 2) + std::pow(e, 3) / 12 * kappa * kappa * lambda2);
}

/// The same strip, whose end a rigid body turns once around.
problem::Problem strip_rolled_to_a_circle(double e) {
  problem::Problem p = rolled_strip(e, 0);
  p.shell.supports.pop_back();
  const std::optional<double> open;
  p.rigid_bodies.push_back({.name = "end",
                            .boundaries = {"right"},
                            .reference = {1, 0, 0},
                            .fixed = {open, 0.0, open, 0.0, -2 * std::numbers::pi, 0.0}});
  return p;
}

TEST(FiniteRotations, OfAStripThatItsEndDirectorRollsUp) {
  constexpr double e = 0.1, theta = 2.5;
  const problem::Problem p = rolled_strip(e, theta);
  EXPECT_FALSE(examination::has_errors(examination::examine(p)));
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  EXPECT_NEAR(r.summary.energy.total() / energy_of_rolled_strip(e, theta), 1, 1e-8);
  EXPECT_NEAR(r.summary.max_rotation, theta, 1e-9);
}

// Steps prescribe rotations beyond half a turn: a rigid body turns the end once around, and the strip closes to a circle.
TEST(FiniteRotations, OfAStripThatARigidBodyRollsUpToACircle) {
  constexpr double e = 0.1, theta = 2 * std::numbers::pi;
  problem::Problem p = strip_rolled_to_a_circle(e);
  p.steps = {{.name = "roll", .parts = 6}};
  EXPECT_FALSE(examination::has_errors(examination::examine(p)));
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  EXPECT_NEAR(r.summary.energy.total() / energy_of_rolled_strip(e, theta), 1, 1e-8);
  ASSERT_EQ(r.summary.body_reactions.size(), 1U);
  EXPECT_NEAR(r.summary.body_reactions[0].rotation[1], -theta, 1e-9);
  EXPECT_NEAR((r.summary.body_reactions[0].displacement - Eigen::Vector3d(-1, 0, 0)).norm(), 0, 1e-7);
  EXPECT_EQ(r.history[2].factors.supports, 0.5);
  EXPECT_NEAR(r.history[2].summary.body_reactions[0].rotation[1], -theta / 2, 1e-9);
}

// Where strains are those between interpolated surfaces, rigid rotations by a right angle cost nothing at any degree. Else low
// degrees feel them on a curved shell. The answers to a load agree.
TEST(ObjectiveStrains, AreZeroForRigidRotations) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  for (const int degree : {1, 2, 3}) {
    std::vector<double> energies;
    for (const bool is_objective : {false, true}) {
      problem::Problem p = quarter_ring(0.02, 1);
      p.shell.rotations = element::Rotations::finite;
      p.shell.is_objective = is_objective;
      p.shell.loads.on_areas = {force(0, 0, -1e-8)};
      p.discretisation.degree = degree;
      const Result r = solve(p, MPI_COMM_WORLD);
      const assembly::DiscreteShell& discrete = *r.solution->discrete;
      algebra::Vector y(discrete.space().layout, 6);
      for (std::size_t i = 0; i < discrete.points.size(); ++i) {
        Eigen::Map<Eigen::Vector3d>{y.at(i).data()} = turn * discrete.points[i].phi - discrete.points[i].phi;
        Eigen::Map<Eigen::Vector3d>{y.at(i).data() + 3} = turn * discrete.points[i].a3 - discrete.points[i].a3;
      }
      energies.push_back(discrete.energies(y).total());
    }
    EXPECT_LT(energies[1], 1e-24);
    EXPECT_GT(energies[0], 1e4 * energies[1]) << degree;
  }
}

TEST(ObjectiveStrains, GiveTheSameAnswer) {
  std::vector<double> energies;
  for (const bool is_objective : {false, true}) {
    problem::Problem p = quarter_ring(0.02, 1);
    p.shell.rotations = element::Rotations::finite;
    p.shell.is_objective = is_objective;
    p.shell.obstacles.all = {table(-1.01 + 0.2)};
    const Result r = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    energies.push_back(r.summary.energy.total());
  }
  EXPECT_NEAR(energies[1] / energies[0], 1, 1e-6);
}

problem::Step controlled(const std::string& probe, double to, int parts) {
  return {.name = fmt::format("to {:g}", to), .control = problem::Control{.probe = probe, .to = to}, .parts = parts};
}

// A cap under a dead load reaches its largest load and goes on, while the deflection of its apex is controlled. Reference
// (finite.json, N6cap): at the limit point the load factor 0.269507572237496 at 1e-3, the energy 2.87445331776456e-07.
TEST(LoadsThatFollowADisplacement, PassTheLimitPointOfACap) {
  problem::Problem p = disk_of({"x", "y", "sqrt(1-x^2-y^2)"}, 0.02, std::sin(0.3), 1);
  p.shell.rotations = element::Rotations::finite;
  p.shell.loads.on_areas = {force(0, 0, -1e-3)};
  p.probes = {{.name = "apex", .at = {0, 0}}};
  p.steps = {controlled("apex", -0.02076279827, 2), controlled("apex", -0.06, 4)};
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  const HistoryEntry& limit = r.history.at(1);
  EXPECT_NEAR(limit.factors.loads / 0.269507572237496, 1, 1e-5);
  EXPECT_NEAR(limit.summary.energy.total() / 2.87445331776456e-07, 1, 1e-5);
  EXPECT_NEAR(limit.probes[0].values.u[2], -0.02076279827, 1e-12);
  EXPECT_NEAR(*limit.stability->margin_under_loads, 0, 1e-4);
  EXPECT_NEAR(*limit.controlled_displacement, -0.02076279827, 1e-15);
  // Beyond it, less load is in equilibrium: stable as long as the deflection is controlled, until the load rises again.
  EXPECT_LT(r.history[3].factors.loads, 0.9 * limit.factors.loads);
  EXPECT_GT(r.history[3].stability->margin, 0.1);
  EXPECT_LT(*r.history[3].stability->margin_under_loads, -0.2);
  EXPECT_GT(*r.history.back().stability->margin_under_loads, 0.2);
  EXPECT_EQ(r.history.back().factors.loads, r.solution->discrete->state.factors.loads);
}

// Parts that are chosen are short where a cap snaps through, and long elsewhere. Its limit point is at 0.2695.
TEST(PartsThatAreChosen, ShowWhereACapSnaps) {
  problem::Problem p = disk_of({"x", "y", "sqrt(1-x^2-y^2)"}, 0.02, std::sin(0.3), 1);
  p.shell.rotations = element::Rotations::finite;
  p.shell.loads.on_areas = {force(0, 0, -1e-3)};
  p.steps = {{.name = "all", .factors = {.loads = 0.4}, .chooses_parts = true}};
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  const auto jump = std::ranges::find_if(r.history, [](const HistoryEntry& h) { return h.level.has_jumped; });
  ASSERT_NE(jump, r.history.end());
  ASSERT_NE(jump, r.history.begin());
  EXPECT_LT(std::prev(jump)->factors.loads, 0.2696);
  EXPECT_GT(jump->factors.loads, 0.2695);
  EXPECT_LT(jump->factors.loads - std::prev(jump)->factors.loads, 0.4 / 60);
  EXPECT_EQ(r.history.back().factors.loads, 0.4);
  EXPECT_LT(r.history.size(), 30U);
  EXPECT_TRUE(std::ranges::is_sorted(r.history, {}, [](const HistoryEntry& h) { return h.factors.time; }));
  EXPECT_THAT(r.warnings, Contains(testing::AllOf(HasSubstr("the shell snaps to another equilibrium at time"),
                                                  HasSubstr("shorter ones do not help"))));
}

// A strip that is rolled up to a circle needs no number of parts.
TEST(PartsThatAreChosen, FollowARotation) {
  problem::Problem p = strip_rolled_to_a_circle(0.1);
  p.steps = {{.name = "roll", .chooses_parts = true}};
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  EXPECT_NEAR(r.summary.body_reactions[0].rotation[1], -2 * std::numbers::pi, 1e-9);
  EXPECT_NEAR((r.summary.body_reactions[0].displacement - Eigen::Vector3d(-1, 0, 0)).norm(), 0, 1e-7);
}

// Half of a pinned arch under a line load at its crown, which moves sideways nowhere. Load factors in units of the bending
// stiffness, from a program for one meridian by exact angles (degree 10).
TEST(LoadsThatFollowADisplacement, AreThoseOfAnArchThatSnaps) {
  constexpr double e = 0.02;
  problem::Problem p = strip_of({"sin(x)", "y", "cos(x)"}, e, 0.3, 0);
  p.shell.rotations = element::Rotations::finite;
  p.shell.supports.push_back(
      {.boundary = "left",
       .components = {fixed(Unknown::displacement, Direction::x), fixed(Unknown::rotation, Direction::x)}});
  p.shell.supports.push_back(held("right", {Direction::x, Direction::z}));
  p.shell.loads.on_edges = {{.boundary = "left", .force = vector(0, 0, -std::pow(e, 3) / (12 * (1 - 0.09)) / 2)}};
  p.probes = {{.name = "crown", .at = {0, 0.05}}};
  p.steps = {controlled("crown", -0.006, 1), controlled("crown", -0.018, 1), controlled("crown", -0.054, 6)};
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  EXPECT_NEAR(r.history[0].factors.loads, 19.34777, 1e-4);
  EXPECT_NEAR(r.history[1].factors.loads, 35.12692, 1e-4);
  EXPECT_NEAR(r.history[7].factors.loads, 13.34605, 1e-4);
  EXPECT_THAT(r.warnings, Contains(HasSubstr("under these loads alone the shell snaps")));
}

// A ball pushes a hinged cap through, which then snaps away from the ball: Newton steps from there do not come to rest, a descent
// finds the inverted cap. It stays when the ball goes back.
TEST(FiniteRotations, OfACapThatSnapsAwayFromTheBall) {
  constexpr double e = 0.02;
  problem::Problem p = disk_of({"x", "y", "-1 - e/2 + sqrt(1-x^2-y^2)"}, e, std::sin(0.4), 0);
  p.shell.rotations = element::Rotations::finite;
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 5.0 / 6);
  p.shell.supports = {held("rim", {Direction::x, Direction::y, Direction::z})};
  p.shell.obstacles.all = {
      {.name = "ball", .shape = obstacle::Ball{.centre = {0, 0, 0.5}, .radius = 0.5}, .face = obstacle::Face::upper}};
  p.shell.obstacles.all[0].motions = {
      {.translation = {0, 0, -0.125}}, {.translation = {0, 0, -0.025}}, {.translation = {0, 0, 0.15}}};
  p.steps = {{.name = "down", .parts = 4}, {.name = "through", .parts = 10}, {.name = "back"}};
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  EXPECT_TRUE(std::ranges::any_of(r.history, [](const HistoryEntry& h) { return h.level.has_jumped; }));
  EXPECT_THAT(r.warnings, Contains(testing::AllOf(HasSubstr("the shell jumps to another equilibrium at time"),
                                                  HasSubstr("parts = \"auto\""))));
  EXPECT_NEAR(r.summary.energy.total() / 1.546581e-6, 1, 1e-3);  // on finer meshes
  EXPECT_EQ(r.summary.obstacles.at(0).nodes, 0);
  EXPECT_GT(r.stability->margin, 0.6);
}

// A displacement that the loads do not move controls nothing.
TEST(LoadsThatFollowADisplacement, MustMoveIt) {
  problem::Problem p = disk_of({"x", "y", "sqrt(1-x^2-y^2)"}, 0.02, std::sin(0.3), 0);
  p.shell.rotations = element::Rotations::finite;
  p.shell.loads.on_areas = {force(0, 0, -1e-3)};
  p.probes = {{.name = "apex", .at = {0, 0}}};
  p.steps = {controlled("apex", 0.01, 1)};
  p.steps[0].control->direction = {1, 0, 0};
  const Result r = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(r.status, contact::Status::no_equilibrium);
  EXPECT_THAT(r.warnings, Contains(HasSubstr("the loads do not move the controlled displacement")));
}

// Very thin shells need products through strains: the assembled matrix rounds their bending stiffness away. The number of Newton
// steps does not depend on the thickness.
TEST(FiniteRotations, OfThinStripsTakeTheSameSteps) {
  std::vector<double> ways;
  for (const double e : {1e-2, 1e-4, 1e-5}) {
    problem::Problem p = strip_of({"x", "y", "0"}, e, 1, 0);
    p.shell.rotations = element::Rotations::finite;
    p.shell.supports.push_back(clamped("left"));
    p.shell.loads.on_edges = {{.boundary = "right", .force = vector(0, 0, 4 * std::pow(e, 3) / 12)}};
    const Result r = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved) << e << r.missed_limits;
    EXPECT_LE(r.last_level().linearisations, 11) << e;
    ways.push_back(r.summary.max_displacement);
  }
  EXPECT_NEAR(ways[1] / ways[0], 1, 1e-3);
  EXPECT_NEAR(ways[2] / ways[1], 1, 1e-5);
}

// A shell that returns to its unloaded state is certified there, where all forces are rounding.
TEST(FiniteRotations, ComeBackToTheUnloadedState) {
  problem::Problem p = disk_of({"x", "y", "sqrt(1-x^2-y^2)"}, 0.02, std::sin(0.3), 0);
  p.shell.rotations = element::Rotations::finite;
  p.shell.loads.on_areas = {force(0, 0, -1e-4)};
  p.steps = {{.name = "press"}, {.name = "release", .factors = {.loads = 0}}};
  const Result r = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  EXPECT_LT(r.summary.max_displacement, 1e-14);
}

TEST(PrescribedDirectors, HaveTheLengthOneAndGoLessThanHalfATurn) {
  const auto with = [](double x, double z) {
    problem::Problem p = rolled_strip(0.1, 0.1);
    p.shell.supports.back().components[0].value = Expression(x);
    p.shell.supports.back().components[2].value = Expression(z);
    return examination::has_errors(examination::examine(p));
  };
  EXPECT_FALSE(with(std::sin(1), std::cos(1) - 1));
  EXPECT_TRUE(with(0, -0.5));
  EXPECT_TRUE(with(0, -1));
  EXPECT_TRUE(with(0, -2));
}

// Loads that follow a displacement into contact are those that bring it about.
TEST(LoadsThatFollowADisplacement, AreThoseThatBringItAboutInContact) {
  problem::Problem p = disk_of({"x", "y", "1.02-sqrt(1-x^2-y^2)"}, 0.02, std::sin(0.5), 1);
  p.shell.rotations = element::Rotations::finite;
  p.shell.loads.on_areas = {force(0, 0, -1e-3)};
  p.shell.obstacles.all = {table(0)};
  p.probes = {{.name = "middle", .at = {0.2, 0.1}}};
  p.steps = {controlled("middle", -0.02, 3)};
  const Result followed = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(followed.status, contact::Status::solved) << followed.missed_limits;
  EXPECT_GT(followed.summary.obstacles.at(0).nodes, 0);
  p.steps = {{.name = "all", .factors = {.loads = followed.history.back().factors.loads}}};
  const Result given = solve(p, MPI_COMM_WORLD);
  EXPECT_NEAR(followed.summary.energy.total() / given.summary.energy.total(), 1, 1e-9);
  EXPECT_NEAR(followed.summary.reaction.force[2] / given.summary.reaction.force[2], 1, 1e-9);
  EXPECT_NEAR(given.probes[0].values.u[2], -0.02, 1e-10);
}

// A ring between plates touches along lines that move from node to node; on the way its stiffness on the touching nodes is not
// definite. Elastica: with E' I = E e^3 / (12 (1 - nu^2)) per width, F d^2 = 5.7422 E' I while the plates' distance d is less than
// 1.4355 radii.
TEST(RingsBetweenPlates, TakeFewFactorisationsWhileTheirContactMoves) {
  constexpr double e = 0.01, width = 0.1;
  problem::Problem p = strip_of({"sin(x)", "y", "1 + e/2 - cos(x)"}, e, std::numbers::pi, 0);
  p.domain = domain::Rectangle{.to = {std::numbers::pi, width}, .cells = {16, 1}};
  p.discretisation.degree = 3;
  p.shell.rotations = element::Rotations::finite;
  for (const char* end : {"left", "right"})
    p.shell.supports.push_back(
        {.boundary = end,
         .components = {fixed(Unknown::displacement, Direction::x), fixed(Unknown::rotation, Direction::x)}});
  p.shell.obstacles.all = {table(0), table(2 + e, -1)};
  p.shell.obstacles.all[0].face = p.shell.obstacles.all[1].face = obstacle::Face::nearer;
  p.shell.obstacles.all[0].name = "floor", p.shell.obstacles.all[1].name = "plate";
  p.shell.obstacles.all[1].motions = {obstacle::Motion{.translation = {0, 0, -0.95}}};
  p.steps = {{.name = "press", .parts = 19}};
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  int newton_steps = 0, factorisations = 0;
  for (const HistoryEntry& h : r.history) {
    newton_steps += h.level.linearisations;
    factorisations += h.level.factorisations;
    const double d = 2 - 0.95 * h.factors.time;
    const double expected = 5.7422 / 2 * width * std::pow(e, 3) / (12 * (1 - 0.09) * d * d);  // half of the ring
    if (d < 1.4) {
      EXPECT_NEAR(h.summary.obstacles[1].reaction.force.norm() / expected, 1, 0.01) << d;
    }
  }
  EXPECT_LT(newton_steps, 150);
  EXPECT_LT(factorisations, 4 * newton_steps);
}

// Turned by more than a right angle, the lower face looks up, and touches a plate above. Its reaction, and the moments of
// supports about their deformed places, add up.
TEST(FiniteRotations, TouchWithTheFaceThatLooksAtTheObstacleThen) {
  constexpr double e = 0.02;
  problem::Problem p = rolled_strip(e, 2.6);
  p.discretisation.refinements = 1;
  p.shell.obstacles.all = {{.shape = obstacle::HalfSpace{.point = {0, 0, 0.5}, .normal = {0, 0, -1}}}};
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  EXPECT_GT(r.summary.touching_nodes, 0);
  EXPECT_GT(r.certificate.min_gap_between, -1e-3 * e);
  EXPECT_LT(r.certificate.moment_balance, 1e-9);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const auto& support : r.summary.support_reactions) moment += support.reaction.moment;
  for (const auto& corner : r.summary.corner_reactions) moment += corner.reaction.moment;
  EXPECT_LT((moment - r.summary.support_reaction.moment).norm(), 1e-9 * r.summary.support_reaction.moment.norm());
}

/// A quarter of a ring under pressure from outside. Its symmetry allows the buckling mode of the ring.
problem::Problem ring_under(double pressure, double e, bool follows) {
  problem::Problem p = quarter_ring(e, 1);
  p.shell.rotations = element::Rotations::finite;
  p.shell.loads.on_areas = {{.pressure = Expression(pressure), .follows = follows}};
  return p;
}

// The radius becomes lambda: A gamma lambda + D (lambda - 1) = p lambda, gamma = (lambda^2 - 1) / 2.
TEST(FollowerPressure, WidensARingAsItsAreaGrows) {
  constexpr double e = 0.05, pressure = 0.002, A = e / (1 - 0.09), D = A * e * e / 12;
  const Result r = solve(ring_under(-pressure, e, true), MPI_COMM_WORLD);
  ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
  double lambda = 1;
  for (int i = 0; i < 50; ++i) {
    const double f = A * (lambda * lambda - 1) / 2 * lambda + D * (lambda - 1) - pressure * lambda;
    lambda -= f / (A * (3 * lambda * lambda - 1) / 2 + D - pressure);
  }
  EXPECT_NEAR(r.summary.max_displacement / (lambda - 1), 1, 1e-6);
  const double gamma = (lambda * lambda - 1) / 2;
  const double energy = 0.1 * std::numbers::pi / 4 * (A * gamma * gamma + D * (lambda - 1) * (lambda - 1));
  EXPECT_NEAR(r.summary.energy.total() / energy, 1, 1e-6);
  EXPECT_LT(r.certificate.force_balance, 1e-9);
  EXPECT_LT(r.certificate.moment_balance, 1e-9);
}

// A thin ring buckles at 3 D / R^3 if the pressure stays normal to it, and at 4 D / R^3 if it keeps its directions.
TEST(FollowerPressure, BucklesARingAtThreeQuartersOfTheDeadPressure) {
  constexpr double e = 0.01, D = e * e * e / (12 * (1 - 0.09));
  for (const auto& [part, follows, critical] :
       {std::tuple(2.7, true, 3.0), std::tuple(3.3, true, 3.0), std::tuple(3.3, false, 4.0)}) {
    const Result r = solve(ring_under(part * D, e, follows), MPI_COMM_WORLD);
    EXPECT_EQ(r.status, part < critical ? contact::Status::solved : contact::Status::unstable) << part << follows;
    ASSERT_TRUE(r.stability.has_value());
    EXPECT_NEAR(r.stability->margin, 1 - part / critical, 0.01) << part << follows;
  }
}

// Loads times 1e-6 reproduce the linear model.
TEST(FiniteRotations, ThatAreSmallAreThoseOfTheLinearModel) {
  problem::Problem p = disk_of({"x", "y", "1.01 + e/2 - sqrt(1 - x^2 - y^2)"}, 0.05, std::sin(0.5), 2);
  p.shell.loads.on_areas = {force(1e-9, 2e-9, -2e-8)};
  p.checks_model = false;
  const Result small = solve(p, MPI_COMM_WORLD);
  p.shell.rotations = element::Rotations::finite;
  const Result finite = solve(p, MPI_COMM_WORLD);
  EXPECT_NEAR(finite.summary.energy.total() / small.summary.energy.total(), 1, 1e-5);
  EXPECT_NEAR(finite.summary.max_displacement / small.summary.max_displacement, 1, 1e-5);
  ASSERT_TRUE(finite.stability.has_value());
  EXPECT_NEAR(finite.stability->margin, 1, 1e-3);
}

/// A strip of length 1 in plane strain between hinges, pushed by its bending stiffness D [N/m].
problem::Problem pinned_strip(double e, double width = 0.1) {
  problem::Problem p = shell_of({"x", "y", "0"}, e, 0);
  p.domain = domain::Rectangle{.to = {1, width}, .cells = {8, 1}};
  p.discretisation.degree = 6;
  p.checks_model = false;
  p.shell.supports = {held("left", {Direction::x, Direction::z}), held("right", {Direction::z}), in_plane("bottom"),
                      in_plane("top")};
  p.shell.loads.on_edges = {{.boundary = "right", .force = vector(-e * e * e / (12 * (1 - 0.09)), 0, 0)}};
  return p;
}

std::vector<double> values_of(const Result& r, Mode::Kind kind) {
  std::vector<double> values;
  for (const Mode& mode : r.solution->modes)
    if (mode.kind == kind) values.push_back(mode.value);
  return values;
}

// Engesser: P_j / D = k^2 / (1 + D k^2 / S), k = j pi, S = k_s mu e.
TEST(Buckling, OfAPinnedStripIsEngessers) {
  for (const double e : {0.1, 0.01}) {
    problem::Problem p = pinned_strip(e);
    p.modes.buckling = 3;
    const Result r = solve(p, MPI_COMM_WORLD);
    const std::vector<double> factors = values_of(r, Mode::Kind::buckling);
    ASSERT_EQ(factors.size(), 3U);
    const double D = e * e * e / (12 * (1 - 0.09)), S = e / (2 * 1.3);
    for (int j = 1; j <= 3; ++j) {
      const double k2 = std::pow(j * std::numbers::pi, 2);
      EXPECT_NEAR(factors[static_cast<std::size_t>(j - 1)] * (1 + D * k2 / S) / k2, 1, 1e-7) << e << " " << j;
    }
  }
}

TEST(Buckling, DoesNotHappenWithoutStresses) {
  problem::Problem p = pinned_strip(0.1);
  p.shell.loads.on_edges.clear();
  p.modes.buckling = 2;
  EXPECT_TRUE(solve(p, MPI_COMM_WORLD).modes.empty());
  p.shell.loads.on_edges = {{.boundary = "right", .force = vector(1e-6, 0, 0)}};  // pulled
  EXPECT_TRUE(solve(p, MPI_COMM_WORLD).modes.empty());
}

// Timoshenko with rotatory inertia, rho = E = 1.
TEST(Vibration, OfAPinnedStripIsTimoshenkos) {
  const std::map<double, std::array<double, 3>> known{
      {0.1, {0.2940669077255566, 1.1267755947754607, 2.3822073789403375}},
      {0.01, {0.029862045587865, 0.119391418032147, 0.268418331377735}}};
  for (const auto& [e, frequencies] : known) {
    problem::Problem p = pinned_strip(e);
    p.shell.loads.on_edges.clear();
    p.shell.sections.common.density = 1;
    p.modes.vibration = 5;
    const Result r = solve(p, MPI_COMM_WORLD);
    std::vector<double> found;
    for (const double value : values_of(r, Mode::Kind::vibration)) found.push_back(std::sqrt(value));
    ASSERT_EQ(found.size(), 5U);
    for (const double omega : frequencies) EXPECT_THAT(found, Contains(testing::DoubleNear(omega, 1e-7 * omega)));
  }
}

// The time limit and Ctrl-C hold for modes, too, which may take longer than the solution.
TEST(Modes, EndWithTheTimeAndWithTheCaller) {
  problem::Problem p = disk_of({"x", "y", "sqrt(1 - x^2 - y^2)"}, 0.02, std::sin(0.3), 1);
  p.shell.sections.common.density = 1;
  p.shell.loads.on_areas = {force(0, 0, -1e-5)};
  p.modes = {.buckling = 2, .vibration = 2};
  p.accuracy = problem::Accuracy{.goals = {{"energy", 0.4}}, .max_seconds = 1e-9};
  const Result late = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(late.status, contact::Status::accuracy_not_reached);
  EXPECT_THAT(late.missed_limits, HasSubstr("max_seconds = 1e-09 was over before the buckling loads were found"));
  EXPECT_THAT(late.missed_limits, HasSubstr("was over before the natural frequencies were found"));
  EXPECT_TRUE(late.modes.empty());
  EXPECT_GT(late.summary.energy.total(), 0);
  p.accuracy->max_seconds = 1e9;
  const Result in_time = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(in_time.status, contact::Status::solved) << in_time.missed_limits;
  EXPECT_EQ(in_time.modes.size(), 4U);
  p.accuracy.reset();
  p.discretisation.refinements = 0;
  bool is_finished = false;
  Observer observer;
  observer.level = [&](int, const Level&) { is_finished = true; };
  observer.stop = [&] { return is_finished; };
  const Result interrupted = solve(p, MPI_COMM_WORLD, observer);
  EXPECT_EQ(interrupted.status, contact::Status::interrupted);
  EXPECT_TRUE(interrupted.modes.empty());
  EXPECT_GT(interrupted.summary.energy.total(), 0);
}

// A square plate without supports has six rigid motions, then the frequencies of a thin plate, omega L^2 sqrt(rho e / D), by the Ritz
// method with Legendre polynomials of degree 14. The NAFEMS benchmark FV12 has them in Hz, for L = 10 m, e = 0.05 m, E = 200 GPa, nu =
// 0.3, rho = 8000 kg/m^3. (Products of beam functions give upper bounds, which are often cited: 13.49, 19.79, 24.43 in the guide VPCS,
// test SDLS01.) Both models are at rest before.
TEST(Vibration, OfAFreePlateBeginsWithItsRigidMotions) {
  constexpr std::array known{13.4682, 19.5961, 24.2702}, benchmark{1.622, 2.360, 2.922};
  const double hertz = std::sqrt(200e9 * 0.05 * 0.05 / (12 * (1 - 0.09) * 8000)) / (2 * std::numbers::pi * 100);
  for (std::size_t i = 0; i < known.size(); ++i) EXPECT_NEAR(known[i] * hertz, benchmark[i], 1e-3);
  for (const element::Rotations rotations : {element::Rotations::small, element::Rotations::finite}) {
    problem::Problem p = shell_of({"x", "y", "0"}, 1e-3, 0);
    p.domain = domain::Rectangle{.to = {1, 1}, .cells = {4, 4}};
    p.discretisation.degree = 5;
    p.shell.rotations = rotations;
    p.shell.sections.common.density = 1;
    p.modes.vibration = 9;
    EXPECT_FALSE(has_errors(examination::examine(p)));
    const Result r = solve(p, MPI_COMM_WORLD);
    EXPECT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    EXPECT_TRUE(r.warnings.empty());
    const std::vector<double> values = values_of(r, Mode::Kind::vibration);
    ASSERT_EQ(values.size(), 9U);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(values[i], 0);
    for (std::size_t i = 0; i < known.size(); ++i)
      EXPECT_NEAR(std::sqrt(values[6 + i] * 12 * (1 - 0.09)) / 1e-3, known[i], 1e-3 * known[i]);
    p.shell.loads.on_areas = {force(0, 0, -1e-9)};
    EXPECT_TRUE(has_errors(examination::examine(p)));
  }
}

// Under half of the buckling load, the square of the lowest frequency is half; above the load the motion grows.
TEST(Vibration, FeelsTheStressesOfTheSolution) {
  double before = 0;
  for (const double part : {0.0, 0.5, 1.1}) {
    problem::Problem p = pinned_strip(0.01);
    p.shell.loads.on_edges[0].force = vector(-part * 9.867285681894 * 1e-6 / (12 * (1 - 0.09)), 0, 0);
    p.shell.sections.common.density = 1;
    p.modes.vibration = 1;
    const double value = values_of(solve(p, MPI_COMM_WORLD), Mode::Kind::vibration).at(0);
    if (part == 0) before = value;
    EXPECT_NEAR(value / before, 1 - part, 1e-4);
  }
}

// The margin of stability falls to 0 at Engesser's load. Above it the straight strip is an equilibrium, but not a stable one.
TEST(Stability, OfACompressedStripEndsAtItsBucklingLoad) {
  for (const double part : {0.5, 1.1}) {
    problem::Problem p = pinned_strip(0.01);
    p.shell.rotations = element::Rotations::finite;
    p.shell.loads.on_edges[0].force = vector(-part * 9.867285681894 * 1e-6 / (12 * (1 - 0.09)), 0, 0);
    const Result r = solve(p, MPI_COMM_WORLD);
    EXPECT_EQ(r.status, part < 1 ? contact::Status::solved : contact::Status::unstable) << r.missed_limits;
    ASSERT_TRUE(r.stability.has_value());
    EXPECT_NEAR(r.stability->margin, 1 - part, 1e-3);
    ASSERT_EQ(r.solution->modes.size(), 1U);
    EXPECT_EQ(r.solution->modes[0].name(), "softest_motion");
  }
}

// A shallow cap carries 0.74 of its limit load (2.695e-4) upright, and is turned inside out by 1.11 of it.
TEST(Stability, OfAShallowCapEndsInASnap) {
  for (const double load : {2e-4, 3e-4}) {
    problem::Problem p = disk_of({"x", "y", "sqrt(1 - x^2 - y^2)"}, 0.02, std::sin(0.3), 1);
    p.shell.rotations = element::Rotations::finite;
    p.shell.loads.on_areas = {force(0, 0, -load)};
    const Result r = solve(p, MPI_COMM_WORLD);
    EXPECT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    EXPECT_EQ(r.levels.front().has_jumped, load > 2.695e-4);
    EXPECT_EQ(r.summary.max_relative_displacement > 3, load > 2.695e-4);
    EXPECT_EQ(testing::Value(r.warnings, testing::Contains(HasSubstr("the shell snaps to another equilibrium: "))),
              load > 2.695e-4);
  }
}

// A strip pressed on a table keeps its contact: its free parts vibrate, clamped where the contact begins.
TEST(Vibration, KeepsTouchingNodesOnTheObstacle) {
  problem::Problem p = pressed_strip();
  p.shell.sections.common.density = 1;
  p.modes.vibration = 2;
  const Result r = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(r.solution->modes.size(), 2U);
  const auto& discrete = *r.solution->discrete;
  for (const Mode& mode : r.solution->modes)
    for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
      if (r.solution->nodal.touching.at(i)[0] > 0.5) {
        const auto v = assembly::node_values(mode.shape, i);
        const obstacle::Gap& gap = discrete.coordinates.gaps[0][i];
        EXPECT_NEAR(gap.normal.dot(v.head<3>() + gap.arm * v.tail<3>()), 0, 1e-9);
      }
}

}  // namespace
}  // namespace plastron::computation

// Meshes for a requested accuracy: the cells that are divided, the end of the sequence, and numbers as accurate as requested.
#include <gtest/gtest.h>
#include <plastron/computation/adaptivity.hpp>
#include <plastron/computation/level.hpp>
#include <plastron/computation/resources.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/computation/verify.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/meshing/chord_cuts.hpp>
#include <plastron/meshing/marks.hpp>
#include <plastron/meshing/sequence.hpp>
#include <plastron/problem/goal_names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <set>
#include <thread>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;

problem::Problem accurate_bowl(double tolerance) {
  problem::Problem p = pressed_bowl();
  p.discretisation = {.degree = 3, .layers = problem::Layers::automatic, .refinements = 0};
  p.accuracy = problem::Accuracy{.goals = {{"energy", tolerance}, {"reaction", tolerance}}};
  return p;
}

/// Degree 4, uniformly refined to 100 000 unknowns.
constexpr double bowl_energy = 1.48023e-5, bowl_reaction = 1.84828e-4, known_to = 1e-4;

double value_of(const Result& result, const std::string& name) {
  const auto& goals = result.levels.back().goals;
  const auto found = std::ranges::find(goals, name, &estimation::GoalRecord::name);
  EXPECT_NE(found, goals.end());
  return found == goals.end() ? NAN : found->value;
}

TEST(Accuracy, IsReachedInTruth) {
  for (const double tolerance : {1e-2, 1e-3}) {
    const Result result = solve(accurate_bowl(tolerance), MPI_COMM_WORLD);
    ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
    EXPECT_NEAR(value_of(result, "energy"), bowl_energy, (tolerance + known_to) * bowl_energy);
    EXPECT_NEAR(value_of(result, "reaction"), bowl_reaction, (tolerance + known_to) * bowl_reaction);
    EXPECT_EQ(value_of(result, "energy"), result.summary.energy.total());
  }
}

TEST(Accuracy, AsksForNoMoreThanItMust) {
  const auto unknowns = [](double tolerance) {
    return solve(accurate_bowl(tolerance), MPI_COMM_WORLD).levels.back().unknowns;
  };
  EXPECT_LT(unknowns(1e-2), 8000);
  EXPECT_LT(2 * unknowns(1e-2), 3 * unknowns(1e-3));
}

TEST(Accuracy, IsTheSameOnAnyNumberOfRanks) {
  const Result together = solve(accurate_bowl(3e-3), MPI_COMM_WORLD), alone = solve(accurate_bowl(3e-3), MPI_COMM_SELF);
  ASSERT_EQ(together.levels.size(), alone.levels.size());
  for (std::size_t l = 0; l < alone.levels.size(); ++l) {
    EXPECT_EQ(together.levels[l].unknowns, alone.levels[l].unknowns);
    for (std::size_t g = 0; g < alone.levels[l].goals.size(); ++g) {
      const estimation::GoalRecord &a = together.levels[l].goals[g], &b = alone.levels[l].goals[g];
      EXPECT_NEAR(a.value, b.value, 1e-9 * b.scale);
      EXPECT_NEAR(a.error, b.error, 1e-6 * b.error + 1e-12 * b.scale);
    }
  }
}

/// The same cells at one degree more decide. Their change is within the estimate, and they are counted as unknowns.
TEST(Accuracy, IsConfirmedByOneDegreeMore) {
  const Result result = solve(accurate_bowl(1e-3), MPI_COMM_SELF);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_GT(result.levels.back().seconds.witness, 0);
  for (const estimation::GoalEstimate& goal : result.estimates->goals) {
    ASSERT_TRUE(goal.at_higher_degree) << goal.name;
    EXPECT_EQ(goal.tolerance, 1e-3);
    EXPECT_LE(std::abs(*goal.at_higher_degree - goal.value), goal.error() * (1 + 1e-12));
    EXPECT_LE(2 * goal.error(), 1e-3 * goal.value);
    const double exact = goal.name == "energy" ? bowl_energy : bowl_reaction;
    EXPECT_LT(std::abs(goal.value + goal.difference() - exact), std::abs(goal.value - exact) + known_to * exact);
  }
  problem::Problem higher = accurate_bowl(1e-3);  // a separate run on the same cells
  const auto& space = result.solution->discrete->space();
  higher.accuracy.reset();
  higher.discretisation.degree += 1;
  fem::MeshSequence meshes(mesh::CoarseMesh(*space.coarse), higher.discretisation.degree, MPI_COMM_SELF);
  std::set<fem::CellPlace> places;
  for (const fem::Cell& cell : space.cells) places.insert(fem::place_of(cell));
  while (meshes.space()->global_cells < space.global_cells) {
    std::vector<signed char> marks;
    for (const fem::Cell& cell : meshes.space()->cells) marks.push_back(places.contains(fem::place_of(cell)) ? 0 : 1);
    meshes.refine({}, marks);
  }
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, higher.charts);
  const LevelResult alone = solve_level({}, assembly::discretise(meshes.space(), surface, higher.shell, {}), {});
  EXPECT_NEAR(alone.record.energy, *result.estimates->goals[0].at_higher_degree, 1e-9 * bowl_energy);
}

/// A mesh whose problem at one degree more would be too large is not accepted, however small its estimates are.
TEST(Accuracy, WithFiniteRotationsIsConfirmedInFewerSteps) {
  problem::Problem p = accurate_bowl(1e-2);
  p.shell.rotations = element::Rotations::finite;
  int steps = 0, before_estimates = 0, of_solution = 0, of_witness = 0;
  Observer observer;
  observer.phase = [&](int, std::string_view phase) {
    if (phase == "geometry") steps = before_estimates = 0;
    if (phase == "contact") ++steps;
    if (phase == "estimates") before_estimates = steps;
    if (phase == "certificate" && before_estimates > 0) {
      of_solution = before_estimates;
      of_witness = steps - before_estimates;
    }
  };
  const Result result = solve(p, MPI_COMM_SELF, observer);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_GT(of_witness, 0);
  EXPECT_LT(of_witness + 1, of_solution);  // to 1e-9 it takes one step fewer
}

TEST(Accuracy, IsNotReachedWhereNothingLargerCanConfirmIt) {
  problem::Problem p = accurate_bowl(1e-2);
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  p.accuracy->max_unknowns = 1.5 * static_cast<double>(result.levels.back().unknowns);
  const Result limited = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(limited.status, contact::Status::accuracy_not_reached);
  EXPECT_NE(limited.missed_limits.find("max_unknowns"), std::string::npos) << limited.missed_limits;
  EXPECT_FALSE(limited.estimates->goals[0].at_higher_degree);
}

/// An energy within 1e-2 says little about the edge of the bowl's contact zone. Within 1e-4 the edge is part of the answer.
TEST(Accuracy, OfTheEnergyIsThatOfContactEdgesToo) {
  problem::Problem p = accurate_bowl(1e-4);
  p.accuracy->goals.pop_back();  // the reaction
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  ASSERT_TRUE(result.estimates->edge_change);
  EXPECT_LE(*result.estimates->edge_change, 15e-4);
  constexpr double radius = 0.1897323;  // of the patch, reference R4cap_e0.02_p0.002
  double sum = 0, length = 0;
  for (const auto& line : result.summary.obstacles.at(0).zones.at(0).lines)
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const double step = (line.points[i].x - line.points[i - 1].x).norm();
      sum += step * (line.points[i].x + line.points[i - 1].x).norm() / 2;
      length += step;
    }
  EXPECT_NEAR(sum / length, radius, 1e-3 * radius);
}

/// The layer at the edge of this zone is a thousandth of the zone: to resolve it costs many times what the numbers cost.
TEST(Accuracy, OfNumbersEndsTheMeshesThoughEdgesOfZonesWouldCostMuchMore) {
  problem::Problem p = with_chart(accurate_bowl(1e-3), {"x", "y", "0.0105"});
  p.domain = domain::Disk{.radius = 1};
  p.shell.sections.common.thickness = Expression(0.001);
  p.shell.loads.on_areas = {force(0, 0, -2e-9)};
  p.discretisation.degree = 4;
  p.checks_model = false;
  const Result result = solve(p, MPI_COMM_SELF);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  const auto is_accurate = [](const Level& level) {
    return level.seconds.witness > 0 && std::ranges::all_of(level.goals, &estimation::GoalRecord::is_met);
  };
  const auto first = std::ranges::find_if(result.levels, is_accurate);
  ASSERT_NE(first, result.levels.end());
  EXPECT_LE(result.levels.back().unknowns, 2 * first->unknowns);
}

TEST(Accuracy, HasAWitnessThatKeepsPointsWhereTheyAreHeld) {
  problem::Problem p = pressed_strip();
  EXPECT_EQ(degrees_of_witness(p), 1);
  p.shell.supports.push_back(
      {.components = {fixed(Unknown::displacement, Direction::x)}, .point = Eigen::Vector2d(0, 0)});
  EXPECT_EQ(degrees_of_witness(p), 2);
}

TEST(Accuracy, EndsWhereALimitStands) {
  problem::Problem p = accurate_bowl(1e-5);
  p.accuracy->max_unknowns = 4000;
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::accuracy_not_reached);
  EXPECT_NE(result.missed_limits.find("max_unknowns"), std::string::npos) << result.missed_limits;
  EXPECT_NE(result.missed_limits.find("energy"), std::string::npos) << result.missed_limits;
  EXPECT_LE(result.levels.back().unknowns, 4000);
  EXPECT_TRUE(result.solution);
  p.accuracy->max_unknowns = 1e6;
  p.accuracy->max_seconds = 1e-6;
  const Result hasty = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(hasty.status, contact::Status::accuracy_not_reached);
  EXPECT_EQ(hasty.levels.size(), 1U);
  EXPECT_NE(hasty.missed_limits.find("max_seconds"), std::string::npos);
}

/// A strip that a roller presses touches with one row of nodes. The true line of contact lies beside this row.
TEST(Accuracy, OfALineOfContactBetweenNodesIsEstimated) {
  problem::Problem p = pressed_strip();
  p.charts.clear();
  p.charts.emplace("", Chart({"x", "y", "0"}, {}));
  p.domain = domain::Rectangle{.from = {-1, 0}, .to = {1, 0.25}, .cells = {8, 1}};
  p.shell.sections.common.thickness = Expression(0.1);
  p.shell.loads.on_areas.clear();
  p.shell.obstacles.all = {{.shape = obstacle::Cylinder{.point = {0.13, 0, 0.1}, .axis = {0, 1, 0}, .radius = 0.1},
                            .face = obstacle::Face::upper}};
  p.shell.obstacles.are_linear = true;
  constexpr double energy = 7.165791e-07, reaction = 3.050698e-05;  // degree 4, energy and reaction to 1e-6
  for (const int degree : {2, 4}) {
    p.discretisation = {.degree = degree, .refinements = degree == 2 ? 3 : 2};
    const Result result = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
    for (const estimation::GoalEstimate& goal : result.estimates->goals) {
      const double error = std::abs(goal.value - (goal.name == "energy" ? energy : reaction));
      EXPECT_GT(goal.error(), 0.5 * error) << goal.name << degree;
      EXPECT_LT(goal.error(), 10 * error) << goal.name << degree;
    }
  }
}

/// A dome under a ball touches along a circle. At one degree more it has the same row of nodes there, which confirms nothing.
TEST(Accuracy, OfACircleOfContactIsReachedInTruth) {
  problem::Problem p = with_chart(accurate_bowl(1e-3), {"x", "y", "-1.01 + sqrt(1 - x^2 - y^2)"});
  p.discretisation.degree = 4;
  p.shell.loads.on_areas.clear();
  p.shell.obstacles.all = {
      {.shape = obstacle::Ball{.centre = {0, 0, 0.4}, .radius = 0.5}, .face = obstacle::Face::upper}};
  p.shell.obstacles.are_linear = true;
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  constexpr double energy = 1.2206129e-05, reaction = 3.636427e-04;  // energy and reaction to 1e-5
  EXPECT_NEAR(value_of(result, "energy"), energy, 1e-3 * energy);
  EXPECT_NEAR(value_of(result, "reaction"), reaction, 1e-3 * reaction);
}

/// A dome that stands on its rim. Nodal reactions over areas double with each mesh, so they are no pressures there.
TEST(Accuracy, OfALineReactionOnTheRimIsEstimatedAsThatOfTheEnergy) {
  problem::Problem p = pressed_bowl();
  p.charts.clear();
  p.charts.emplace("", Chart({"x", "y", "-0.8556429978431134 + sqrt(1 - x^2 - y^2)"}, {}));
  p.shell.sections.common.thickness = Expression(0.05);
  p.shell.supports = {
      {.components = {fixed(Unknown::displacement, Direction::x), fixed(Unknown::displacement, Direction::y)},
       .point = Eigen::Vector2d(0, 0)},
      {.components = {fixed(Unknown::displacement, Direction::y)}, .point = Eigen::Vector2d(0.479425538604203, 0)}};
  p.shell.loads.on_areas = {force(0, 0, -1.25e-4)};
  p.discretisation = {.degree = 2, .refinements = 2};
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  ASSERT_TRUE(result.summary.edge.is_line());
  const auto energy = std::ranges::find(result.estimates->goals, "energy", &estimation::GoalEstimate::name);
  EXPECT_LT(energy->error(), 0.1 * energy->value);
  EXPECT_GT(energy->error(), 0);
}

/// Floor and ceiling: the disk touches the ceiling along a circle, in a ring much narrower than the layer at its edges.
TEST(Accuracy, AsksForNoEdgesOfZonesThatAreLines) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "0"});
  p.domain = domain::Disk{.radius = 1};
  p.shell.sections.common.thickness = Expression(0.02);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.supports = {clamped("rim")};
  p.shell.loads.on_areas = {force(0, 0, 0)};
  p.shell.loads.on_areas[0].force[2] = Expression("-50*0.02^3*cos(2*pi*sqrt(x^2 + y^2))", {});
  p.shell.obstacles.all = {
      {.name = "floor", .shape = obstacle::HalfSpace{.point = {0, 0, -0.02}}},
      {.name = "ceiling", .shape = obstacle::HalfSpace{.point = {0, 0, 0.015}, .normal = {0, 0, -1}}}};
  p.discretisation = {.degree = 4, .layers = problem::Layers::automatic, .refinements = 0};
  p.accuracy = problem::Accuracy{.goals = {{"energy", 1e-2}, {"reaction", 1e-2}}, .max_unknowns = 30000};
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
}

/// A plate at rest on a table, clamped all round: it has no energy, and its supports carry nothing. On a mesh the reactions at
/// their nodes are theirs, which no strain shows.
TEST(Accuracy, OfAPlateThatRestsOnATableBetweenItsSupportsIsReachedInTruth) {
  for (const bool is_disk : {false, true})
    for (const double L : {1.0, 1e-6, 1e6}) {
      SCOPED_TRACE(fmt::format("{} {}", is_disk ? "disk" : "square", L));
      problem::Problem p = free_plate();
      p.domain = is_disk ? domain::Domain(domain::Disk{.radius = L / 2})
                         : domain::Domain(domain::Rectangle{.to = {L, L}, .cells = {2, 2}});
      p.shell.sections.common.thickness = Expression(0.01 * L);
      p.shell.supports.clear();
      for (const std::string& boundary : domain::boundary_names(p.domain))
        p.shell.supports.push_back(clamped(boundary));
      p.shell.loads.on_areas = {force(0, 0, -1e-3)};
      p.shell.obstacles.all = {{.shape = obstacle::HalfSpace{.point = {0, 0, -0.005 * L}}}};
      p.discretisation = {.degree = 4, .layers = problem::Layers::automatic, .refinements = 0};
      const double tolerance = is_disk ? 1e-2 : 1e-3;  // no rows are cut along a curved edge
      p.accuracy = problem::Accuracy{.goals = {{"energy", tolerance}, {"reaction", tolerance}}, .max_unknowns = 2e4};
      const Result result = solve(p, MPI_COMM_WORLD);
      EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
      const double load = result.summary.loads.force.norm();
      for (const estimation::GoalEstimate& goal : result.estimates->goals) {
        const double error = goal.name == "energy" ? goal.value : std::abs(load - goal.value);
        EXPECT_LE(error, 1.1 * goal.error()) << goal.name;
        EXPECT_LT(error, tolerance * load) << goal.name;
      }
    }
}

/// The distance to an obstacle that is much larger than the shell has few digits, and nothing else moves.
TEST(Accuracy, OfAPanelThatRestsOnAMuchLargerCylinderIsReached) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "sqrt(1e4 - (x - 0.25)^2) - 100"});
  p.domain = domain::Rectangle{.to = {0.5, 0.5}, .cells = {2, 2}};
  p.shell.sections.common.thickness = Expression(0.005);
  p.shell.sections.common.material = shell::Material::from_young_poisson(70e9, 0.3, 1);
  for (const char* boundary : {"left", "right", "bottom", "top"}) p.shell.supports.push_back(clamped(boundary));
  p.shell.loads.on_areas = {force(0, 0, -2e4)};
  p.shell.obstacles.all = {
      {.shape = obstacle::Cylinder{.point = {0.25, 0, -100}, .axis = {0, 1, 0}, .radius = 99.9975}}};
  p.discretisation = {.degree = 4, .layers = problem::Layers::automatic, .refinements = 0};
  p.accuracy = problem::Accuracy{.goals = {{"energy", 1e-2}, {"reaction", 1e-2}}, .max_unknowns = 2e4};
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << status_text(result);
  EXPECT_NEAR(value_of(result, "reaction"), 5000, 50);
}

/// A mesh that takes longer than expected is stopped, and the previous mesh is the result.
TEST(Accuracy, StopsAMeshWhoseTimeIsOver) {
  problem::Problem p = accurate_bowl(1e-5);
  p.accuracy->max_seconds = 1e-6;
  const Stopwatch first_mesh;
  solve(p, MPI_COMM_WORLD);
  p.accuracy->max_seconds = 1 + 15 * first_mesh.seconds();
  const Stopwatch watch;
  Observer slow;
  slow.iteration = [&](int level, const contact::Iteration&) {
    while (level > 0 && watch.seconds() < p.accuracy->max_seconds)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  };
  const Result result = solve(p, MPI_COMM_WORLD, slow);
  EXPECT_EQ(result.status, contact::Status::accuracy_not_reached);
  EXPECT_NE(result.missed_limits.find("was stopped for max_seconds"), std::string::npos) << result.missed_limits;
  ASSERT_TRUE(result.solution);
  EXPECT_EQ(result.levels.size(), 1U);
  EXPECT_EQ(result.levels.back().cells, result.solution->discrete->space().global_cells);
}

/// Instants on the finest mesh also take time. None is computed beyond the limit.
TEST(Accuracy, EndsBetweenInstantsWhenTimeIsOver) {
  problem::Problem p = accurate_bowl(0.3);
  p.steps = {{.name = "down", .factors = {.loads = 1}, .parts = 5}};
  p.accuracy->max_seconds = 1e-6;
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::accuracy_not_reached);
  EXPECT_EQ(result.history.size(), 1U);
  EXPECT_EQ(result.levels.size(), 1U);  // none at the last instant
  EXPECT_NE(result.missed_limits.find("max_seconds = 1e-06 was over before time 0.4"), std::string::npos)
      << result.missed_limits;
}

TEST(Memory, OfTheNextMeshIsForeseen) {
  const MemoryUse use = memory_use(MPI_COMM_WORLD);
  EXPECT_GT(use.peak, 1e7);
  EXPECT_GT(use.limit, use.peak);
  EXPECT_LT(use.limit, 1e15);
  EXPECT_EQ(memory_obstacle({.peak = 1e9, .limit = 16e9}, 4), "");
  EXPECT_EQ(memory_obstacle({.peak = 1e9, .limit = 4e9}, 0.5), "");
  EXPECT_EQ(memory_obstacle({.peak = 1e9, .limit = 4e9}, 4),
            "the next mesh would take about 5.3 GB of memory, and there are 4 GB for it");
}

/// A result that misses its accuracy says where: nearly all of the error is in the cells at the corner.
TEST(Accuracy, TellsWhereTheErrorIsThatStays) {
  problem::Problem p = cantilever_plate();
  p.domain = domain::Polygon{.corners = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  p.shell.supports = {clamped(domain::boundary_names(p.domain).front())};
  p.discretisation = {.degree = 3, .refinements = 1};
  p.probes = {{"corner", {1, 1}}};
  p.accuracy = problem::Accuracy{.goals = {{"probe.corner.M.11", 1e-3}}, .max_unknowns = 6000};
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::accuracy_not_reached);
  EXPECT_NE(result.missed_limits.find("half of the estimated error of probe.corner.M.11 lies in "), std::string::npos)
      << result.missed_limits;
}

/// The moment at a re-entrant corner grows with each division of the cells there.
TEST(Accuracy, IsGivenUpForWhatHasNoLimit) {
  problem::Problem p = cantilever_plate();
  p.domain = domain::Polygon{.corners = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  p.shell.supports = {clamped(domain::boundary_names(p.domain).front())};
  p.discretisation = {.degree = 3, .refinements = 0};
  p.probes = {{"corner", {1, 1}}};
  p.accuracy = problem::Accuracy{.goals = {{"probe.corner.M.11", 1e-3}}};
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::accuracy_not_reached);
  EXPECT_NE(result.missed_limits.find("may have no limit"), std::string::npos) << result.missed_limits;
  EXPECT_LT(result.levels.size(), 25U);
  EXPECT_TRUE(result.solution);
}

/// A component that vanishes by symmetry is accurate if its error is small beside the other components.
TEST(Accuracy, TakesNumbersThatVanish) {
  problem::Problem p = accurate_bowl(1e-2);
  p.probes = {{"centre", {0, 0}}};
  p.accuracy->goals = {{"probe.centre.u.x", 1e-2},
                       {"probe.centre.u.z", 1e-3},
                       {"probe.centre.N.12", 0.3},
                       {"support.rim.force.y", 1e-2}};
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_NEAR(value_of(result, "probe.centre.u.z"), -0.01, 1e-5);
}

/// For every name of a goal, the value is that of the results.
TEST(Accuracy, MeansTheNumbersOfTheResults) {
  problem::Problem p = accurate_bowl(0.3);
  p.shell.obstacles.all[0].name = "table";
  p.probes = {{"halfway", {0.2, 0.1}}};
  p.accuracy->goals.clear();
  for (const std::string& name : problem::goal_names(p)) p.accuracy->goals.push_back({name, 0.4});
  p.accuracy->max_unknowns = 3000;
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_TRUE(result.solution);
  const auto& s = result.summary;
  const recovery::PointValues& at = result.probes.at(0).values;
  EXPECT_NEAR(value_of(result, "load_work"), s.load_work, 1e-10 * s.load_work);
  EXPECT_NEAR(value_of(result, "reaction"), s.reaction.force.norm(), 1e-9 * s.reaction.force.norm());
  EXPECT_NEAR(value_of(result, "obstacle.table.force.z"), s.reaction.force[2], 1e-9 * s.reaction.force[2]);
  EXPECT_NEAR(value_of(result, "support.rim.force.z"), s.support_reaction.force[2], 1e-9 * s.load_norms);
  EXPECT_NEAR(value_of(result, "contact_area"), s.contact_area, 1e-12);
  EXPECT_NEAR(value_of(result, "probe.halfway.u.z"), at.u[2], 1e-12);
  EXPECT_NEAR(value_of(result, "probe.halfway.r.x"), at.r[0], 1e-11);
}

TEST(Accuracy, HoldsForTrianglesAndJoinedEdgesOnEvenMeshes) {
  problem::Problem p = pressed_bowl();
  p.discretisation = {.cells = mesh::Shape::triangle, .degree = 2, .refinements = 0};
  p.shell.tying = false;
  p.shell.sections.common.thickness = Expression(0.1);
  p.charts.clear();
  p.charts.emplace("", Chart({"x", "y", "0.06 + 1 - sqrt(1 - x^2 - y^2)"}, {}));
  p.shell.loads.on_areas = {force(0, 0, -2e-2)};
  p.accuracy = problem::Accuracy{.goals = {{"energy", 0.05}}};
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  ASSERT_GE(result.levels.size(), 2U);
  for (std::size_t l = 1; l < result.levels.size(); ++l)
    EXPECT_EQ(result.levels[l].cells, 4 * result.levels[l - 1].cells);
}

/// A ball or a roller presses a plate at one place, then slides along it.
struct Sliding {
  obstacle::Shape shape;
  obstacle::Face face;
  double down;
  Eigen::Vector3d along;
  element::Rotations rotations = element::Rotations::small;
};

problem::Problem slid_on_plate(const Sliding& sliding) {
  problem::Problem p;
  p.domain = domain::Rectangle{.to = {1, 0.25}, .cells = {4, 1}};
  p.charts = {{"", Chart({"x", "y", "0"}, {})}};
  p.shell.rotations = sliding.rotations;
  p.shell.sections.common.thickness = Expression(0.02);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.supports = {clamped("left"), clamped("right"), in_plane("bottom"), in_plane("top")};
  p.shell.obstacles.all = {{.name = "tool", .shape = sliding.shape, .face = sliding.face}};
  p.discretisation = {.degree = 4, .refinements = 0};
  p.accuracy = problem::Accuracy{.goals = {{"energy", 2e-2}, {"reaction", 2e-2}}};
  p.checks_model = false;
  return p;
}

/// Each instant is as accurate as a case of its own, with the obstacle at its place: also those between the first and the last.
TEST(Accuracy, IsReachedAtEachInstantOfAnObstacleThatSlides) {
  using obstacle::Face;
  const std::vector<Sliding> all{
      {obstacle::Cylinder{.point = {0.27, 0, 0.11}, .axis = {0, 1, 0}, .radius = 0.1},
       Face::upper,
       -0.005,
       {0.41, 0, 0}},
      {obstacle::Cylinder{.point = {0.7, 0, -0.06}, .axis = {0, 1, 0}, .radius = 0.05},
       Face::lower,
       0.004,
       {-0.5, 0, 0},
       element::Rotations::finite},
      {obstacle::Ball{.centre = {0.31, 0.1, 0.21}, .radius = 0.2}, Face::upper, -0.004, {0.37, 0.04, 0}}};
  for (const Sliding& sliding : all) {
    problem::Problem p = slid_on_plate(sliding);
    p.steps = {{.name = "press"}, {.name = "slide", .parts = 2}};
    const Eigen::Vector3d down(0, 0, sliding.down);
    p.shell.obstacles.all[0].motions = {{.translation = down}, {.translation = sliding.along}};
    const Result r = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    ASSERT_EQ(r.history.size(), 3U);
    EXPECT_EQ(r.levels.back().unknowns, r.history.back().level.unknowns);
    for (const HistoryEntry& instant : r.history) {
      problem::Problem alone = slid_on_plate(sliding);
      alone.shell.obstacles.all[0].placement.translation = down + (instant.factors.time - 1) * sliding.along;
      const Result own = solve(alone, MPI_COMM_WORLD);
      ASSERT_EQ(own.status, contact::Status::solved) << own.missed_limits;
      const auto value = [](const solution::Summary& s) {
        return std::pair(s.energy.total(), s.reaction.force.norm());
      };
      const auto [energy, reaction] = value(own.summary);
      const auto [energy_in_step, reaction_in_step] = value(instant.summary);
      EXPECT_NEAR(energy_in_step / energy, 1, 3e-2) << instant.factors.time;
      EXPECT_NEAR(reaction_in_step / reaction, 1, 3e-2) << instant.factors.time;
      ASSERT_EQ(instant.level.goals.size(), 2U);
      for (const estimation::GoalRecord& goal : instant.level.goals) EXPECT_TRUE(goal.is_met()) << goal.name;
    }
  }
}

/// An instant that misses the accuracy is named, also where later ones reach it.
TEST(Accuracy, ThatIsMissedAtAnInstantIsTold) {
  problem::Problem p = accurate_bowl(1e-2);
  p.steps = {{.name = "down"}, {.name = "up", .factors = {.loads = 0.1}}};
  p.accuracy->max_unknowns = 1500;
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.history.size(), 2U);
  EXPECT_EQ(result.history[0].status, contact::Status::accuracy_not_reached);
  EXPECT_EQ(result.status, contact::Status::accuracy_not_reached);
  EXPECT_NE(result.missed_limits.find("at time 1: "), std::string::npos) << result.missed_limits;
}

/// Nearly nothing touches at the first instant. Its mesh would be too coarse for the last one.
TEST(Accuracy, IsReachedAtTheLastInstant) {
  constexpr double tolerance = 1e-2;
  problem::Problem p = accurate_bowl(tolerance);
  p.steps = {{.name = "a little", .factors = {.loads = 0.3}}, {.name = "all", .factors = {.loads = 1}}};
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  ASSERT_EQ(result.history.size(), 2U);
  EXPECT_EQ(result.history[0].factors.loads, 0.3);
  EXPECT_LT(result.history[0].summary.energy.total(), 0.3 * bowl_energy);
  EXPECT_NEAR(result.summary.energy.total(), bowl_energy, (tolerance + known_to) * bowl_energy);
  EXPECT_NEAR(result.summary.reaction.force.z(), bowl_reaction, (tolerance + known_to) * bowl_reaction);
}

/// A tube between a floor and a plate that a force presses on it. The sum of both reactions has no correct digits.
TEST(Accuracy, OfReactionsThatCancelIsMeasuredByEachOfThem) {
  const double pi = 3.141592653589793, width = 0.25, pressing = 0.01;
  problem::Problem p = with_chart(free_plate(), {"sin(x)", "y", "1.01 - cos(x)"});
  p.domain = domain::Rectangle{.from = {-pi, 0}, .to = {pi, width}, .cells = {16, 1}};
  p.joins = {{{"left", "right"}}};
  p.shell.sections.common.thickness = Expression(0.02);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1e6, 0.3, 1);
  p.shell.supports = {in_plane("bottom"), in_plane("top")};
  for (const double x : {0.0, -pi})
    p.shell.supports.push_back(
        {.components = {fixed(Unknown::displacement, Direction::x)}, .point = Eigen::Vector2d(x, width / 2)});
  p.shell.obstacles.all = {{.name = "plate",
                            .shape = obstacle::HalfSpace{.point = {0, 0, 2.02}, .normal = {0, 0, -1}},
                            .force = {0, 0, -pressing}},
                           {.name = "floor"}};
  p.discretisation = {.degree = 4, .refinements = 0};
  p.accuracy = problem::Accuracy{.goals = {{"energy", 1e-3}, {"reaction", 1e-3}}};
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_LE(result.levels.size(), 4U);
  const auto& goals = result.levels.back().goals;
  ASSERT_EQ(goals.size(), 4U);
  EXPECT_NEAR(goals[1].scale, 2 * pressing, 1e-6 * pressing);
  for (const std::string name : {"plate", "floor"}) {
    const auto own = std::ranges::find(goals, "obstacle." + name + ".force", &estimation::GoalRecord::name);
    ASSERT_NE(own, goals.end()) << name;
    EXPECT_NEAR(own->scale, pressing, 1e-6 * pressing) << name;
    EXPECT_EQ(own->tolerance, 1e-3) << name;
  }
  EXPECT_NEAR(result.summary.obstacles[1].reaction.force.z(), pressing, 1e-6 * pressing);
}

MeshCells cells_of(const fem::Space& space) {
  MeshCells cells{.cuts = space.coarse->cuts};
  for (std::size_t c = 0; c < space.owned_cells; ++c) cells.places.push_back(fem::place_of(space.cells[c]));
  return cells;
}

void expect_to_be_made_again(const problem::Problem& p, const fem::Space& space) {
  MeshCells cells = cells_of(space);
  const FinestMesh again = finest_mesh(p, MPI_COMM_WORLD, cells);
  EXPECT_EQ(again.space->global_cells, space.global_cells);
  EXPECT_EQ(again.space->layout->global_size, space.layout->global_size);
  std::ranges::sort(cells.places);
  for (std::size_t c = 0; c < again.space->owned_cells; ++c)
    EXPECT_TRUE(std::ranges::binary_search(cells.places, fem::place_of(again.space->cells[c])));
  ASSERT_EQ(again.space->coarse->cells.size(), space.coarse->cells.size());
  const Eigen::Vector2d middle(0.5, 0.5);
  for (std::size_t c = 0; c < space.coarse->cells.size(); ++c)
    EXPECT_LT((again.space->coarse->cells[c].map(middle).value - space.coarse->cells[c].map(middle).value).norm(),
              1e-12);
}

TEST(FinestMesh, IsMadeFromItsCells) {
  const problem::Problem p = accurate_bowl(3e-3);
  fem::MeshSequence meshes = meshing::mesh_sequence(p, MPI_COMM_SELF);
  for (int round = 0; round < 3; ++round) {
    std::vector<signed char> marks(meshes.space()->owned_cells, 0);
    marks.front() = marks[marks.size() / 2] = 1;
    meshes.refine({}, marks);
  }
  EXPECT_FALSE(meshes.space()->continuity.is_identity());
  expect_to_be_made_again(p, *meshes.space());
}

TEST(FinestMesh, IsMadeFromItsCuts) {
  const problem::Problem p = accurate_bowl(1e-3);
  const Result result = solve(p, MPI_COMM_SELF);
  EXPECT_FALSE(result.solution->discrete->space().coarse->cuts.empty());
  expect_to_be_made_again(p, result.solution->discrete->space());
}

TEST(FinestMesh, RefusesCutsOfAnotherMesh) {
  const problem::Problem p = accurate_bowl(1e-3);
  EXPECT_THROW(finest_mesh(p, MPI_COMM_WORLD, {.cuts = std::vector<mesh::Cuts>(1), .places = {}}), mesh::DomainError);
  std::vector<mesh::Cuts> torn(meshing::mesh_sequence(p, MPI_COMM_SELF).space()->coarse->cells.size());
  torn.front()[0] = {0.5};
  EXPECT_THROW(finest_mesh(p, MPI_COMM_WORLD, {.cuts = torn, .places = {}}), mesh::DomainError);
}

/// Edges of the bowl's contact zone run along rings of cells.
TEST(Accuracy, CutsRowsWhereLayersAndContactEdgesRunAlongThem) {
  const Result result = solve(accurate_bowl(1e-3), MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  EXPECT_FALSE(result.solution->discrete->space().coarse->cuts.empty());
  EXPECT_LT(result.levels.back().unknowns, 10000);  // four times as many if all cells are divided in both directions
}

/// A supported point must stay a node. The middle of a cell is no node after its chords are halved.
TEST(ChordCuts, AreInTheMiddleWherePointsAreHeld) {
  fem::MeshSequence meshes = meshing::mesh_sequence(pressed_strip(), MPI_COMM_SELF);
  const fem::Space& space = *meshes.space();
  const fem::Surface surface(space.coarse, pressed_strip().charts);
  estimation::Estimates estimates;
  const std::vector<double> shares(space.owned_cells, 1.0);
  const auto slices = static_cast<std::size_t>(space.degree) + 1;
  std::vector<double> first(slices, 0), none(slices, 0);
  first.front() = 1;  // all at one side
  estimates.profiles.assign(space.owned_cells, {first, none});
  for (const bool halves : {false, true}) {
    const auto cuts = meshing::chord_cuts(
        space, surface, {.shares = shares, .estimates = estimates, .share = 0.5, .halves_only = halves});
    ASSERT_EQ(cuts.size(), space.owned_cells);
    for (const mesh::Cuts& of_cell : cuts) {
      ASSERT_EQ(of_cell[0].size(), 1U);
      EXPECT_EQ(of_cell[0][0], halves ? 0.5 : 0.2);
      EXPECT_TRUE(of_cell[1].empty());
    }
  }
}

/// A large share of one cell alone is no reason to cut a row.
TEST(ChordCuts, AreWorthLessThanOneCellWhereOneHasItAll) {
  fem::MeshSequence meshes = meshing::mesh_sequence(pressed_strip(), MPI_COMM_SELF);
  const fem::Space& space = *meshes.space();
  const fem::Surface surface(space.coarse, pressed_strip().charts);
  estimation::Estimates estimates;
  std::vector<double> shares(space.owned_cells, 0.0);
  shares[3] = 1;
  const std::vector<double> slices(static_cast<std::size_t>(space.degree) + 1, 0.5 / (space.degree + 1));
  estimates.profiles.assign(space.owned_cells, {slices, slices});
  EXPECT_TRUE(
      meshing::chord_cuts(space, surface, {.shares = shares, .estimates = estimates, .share = 0.8, .per_cell = 1})
          .empty());
  // If only the edges of contact zones are goals, the row that an edge crosses is still cut.
  for (std::size_t c = 0; c < space.owned_cells; ++c) estimates.crossed.push_back({c, 1});
  const auto cuts = meshing::chord_cuts(
      space, surface, {.shares = shares, .estimates = estimates, .share = 0.8, .per_cell = 10, .at_edges = true});
  ASSERT_EQ(cuts.size(), space.owned_cells);
  for (const mesh::Cuts& of_cell : cuts) {
    EXPECT_TRUE(of_cell[0].empty());
    EXPECT_EQ(of_cell[1].size(), 1U);
  }
}

/// An obstacle that enters a cell halves its row where that adds fewer cells than its division.
TEST(CutsThrough, HalveTheRowOfACellWhereThatAddsFewCells) {
  fem::MeshSequence meshes = meshing::mesh_sequence(pressed_strip(), MPI_COMM_SELF);
  const fem::Space& space = *meshes.space();
  const fem::Surface surface(space.coarse, pressed_strip().charts);
  ASSERT_EQ(space.owned_cells, 8U);
  const std::vector<std::size_t> some{3, 4};
  const auto cuts = meshing::cuts_through(space, surface, some);
  ASSERT_EQ(cuts.size(), space.owned_cells);
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    EXPECT_EQ(cuts[c][0].size(), c == 3 || c == 4 ? 1U : 0U) << c;
    EXPECT_TRUE(cuts[c][1].empty()) << c;
  }
  problem::Problem wide = pressed_strip();
  wide.domain = domain::Rectangle{.to = {1, 1}, .cells = {8, 8}};
  fem::MeshSequence square = meshing::mesh_sequence(wide, MPI_COMM_SELF);
  EXPECT_TRUE(meshing::cuts_through(*square.space(), fem::Surface(square.space()->coarse, wide.charts), some).empty());
  // Triangles have no rows.
  problem::Problem triangles = pressed_strip();
  triangles.discretisation = {.cells = mesh::Shape::triangle, .degree = 2, .refinements = 0};
  triangles.shell.tying = false;
  fem::MeshSequence of_triangles = meshing::mesh_sequence(triangles, MPI_COMM_SELF);
  const auto coarse = of_triangles.space()->coarse;
  EXPECT_TRUE(meshing::cuts_through(*of_triangles.space(), fem::Surface(coarse, triangles.charts), some).empty());
}

/// For a disk of five cells, whose outer ones have bent sides at the rim: the result of cutting along the rim again and again.
TEST(ChordCuts, LeaveNoCellsThatAreLongAndBentAtOnce) {
  std::map<std::string, geometry::Chart> charts;
  charts.emplace("", geometry::Chart(std::array<std::string, 3>{"x", "y", "0"}, {}));
  fem::MeshSequence meshes(domain::coarse_mesh(domain::Disk{}, mesh::Shape::quadrilateral), 4, MPI_COMM_SELF);
  for (int cuts_made = 0;; ++cuts_made) {
    const fem::Space& space = *meshes.space();
    const auto slices = static_cast<std::size_t>(space.degree) + 1;
    const std::vector<double> none(slices, 0);
    estimation::Estimates estimates;
    estimates.profiles.assign(space.owned_cells, {none, none});
    std::vector<double> shares(space.owned_cells, 0);
    for (std::size_t c = 0; c < space.owned_cells; ++c) {
      const mesh::CellMap& map = space.coarse->cells[static_cast<std::size_t>(space.cells[c].coarse)].map;
      for (std::size_t d = 0; d < 2; ++d)
        for (const double end : {0.0, 1.0}) {
          const Eigen::Vector2d middle = d == 0 ? Eigen::Vector2d(end, 0.5) : Eigen::Vector2d(0.5, end);
          if (map(middle).value.norm() < 1 - 1e-9) continue;  // not at the rim
          (end == 0 ? estimates.profiles[c][d].front() : estimates.profiles[c][d].back()) = 1;
          shares[c] = 1;
        }
    }
    const auto cuts = meshing::chord_cuts(space, fem::Surface(space.coarse, charts),
                                          {.shares = shares, .estimates = estimates, .share = 0.5});
    if (cuts.empty()) {
      EXPECT_GE(cuts_made, 1);
      EXPECT_LE(cuts_made, 4);
      break;
    }
    ASSERT_LT(cuts_made, 20);
    meshes.cut({}, cuts);
  }
}

/// Shares of one goal: 16, 8, 4, 2, 1, 0 ... of the whole.
TEST(Marks, TakeTheLargestSharesUntilTheyMakeUpEnough) {
  fem::MeshSequence meshes = meshing::mesh_sequence(pressed_strip(), MPI_COMM_SELF);
  const fem::Space& space = *meshes.space();
  ASSERT_EQ(space.owned_cells, 8U);
  estimation::Estimates estimates;
  estimates.goals.emplace_back().cells = {1, -16, 0, 4, 2, -8, 0, 0};
  const std::vector<estimation::GoalRecord> goals{{.name = "a", .value = 1, .error = 31, .tolerance = 0.1, .scale = 1}};
  const auto divided = [&](double share) {
    const auto all = meshing::marks(space, goals, estimates, share);
    return std::ranges::count(all, 1);
  };
  EXPECT_EQ(divided(0.5), 1);
  EXPECT_EQ(divided(0.75), 2);
  EXPECT_EQ(divided(0.9), 3);
  const auto some = meshing::marks(space, goals, estimates, 0.5);
  EXPECT_EQ(some[1], 1);
  EXPECT_EQ(some[2], -1);
  EXPECT_EQ(some[0], 0);
}

/// The share over the tolerance of its goal decides.
TEST(Marks, WeighGoalsByTheirTolerances) {
  fem::MeshSequence meshes = meshing::mesh_sequence(pressed_strip(), MPI_COMM_SELF);
  estimation::Estimates estimates;
  estimates.goals.emplace_back().cells = {1, 0, 0, 0, 0, 0, 0, 0};
  estimates.goals.emplace_back().cells = {0, 0, 0, 0, 0, 0, 0, 0.1};
  const std::vector<estimation::GoalRecord> goals{
      {.name = "loose", .value = 1, .error = 1, .tolerance = 0.1, .scale = 1},
      {.name = "tight", .value = 1, .error = 1, .tolerance = 1e-3, .scale = 1}};
  const auto all = meshing::marks(*meshes.space(), goals, estimates, 0.5);
  EXPECT_EQ(all[7], 1);
  EXPECT_EQ(all[0], 0);
}

}  // namespace
}  // namespace plastron::computation

// Whole computations: beams with well-known answers, balance, certificate, and outcomes without solution.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/computation/solve.hpp>

#include <cmath>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;

using contact::Status;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double E = 1e4, thickness = 0.1, length = 2, width = 0.5;
constexpr double bending_stiffness = E * thickness * thickness * thickness / 12;
constexpr double shear_stiffness = E / 2 * thickness;  // k_s e mu with nu = 0, k_s = 1

/// A cantilever without Poisson's effect, so that it is a beam.
problem::Problem beam() {
  problem::Problem p = free_plate();
  p.domain = domain::Rectangle{.to = {length, width}, .cells = {3, 1}};
  p.shell.sections.common.material = shell::Material::from_young_poisson(E, 0, 1);
  p.shell.supports = {clamped("left")};
  p.probes = {{.name = "tip", .at = {length, width / 2}},
              {.name = "root", .at = {0, 0}},
              {.name = "between", .at = {0.77, 0.1}}};
  p.discretisation = {.degree = 3, .refinements = 1};
  return p;
}

TEST(Beam, under_an_end_couple_bends_to_a_parabola) {
  problem::Problem p = beam();
  const double couple = 0.2;
  p.shell.loads.on_edges = {{.boundary = "right", .force = {}, .couple = vector(couple, 0, 0)}};
  for (const int degree : {2, 3, 4}) {
    p.discretisation.degree = degree;
    for (const ProbeValue& v : solve(p, MPI_COMM_SELF).probes) {
      const double x = v.values.x[0], curvature = couple / bending_stiffness;
      EXPECT_NEAR(v.values.r[0], curvature * x, 1e-10);
      EXPECT_NEAR(v.values.u[2], -curvature * x * x / 2, 1e-10);
      EXPECT_NEAR(v.values.M[0], couple, 1e-9);
      EXPECT_LT(v.values.Q.norm(), 1e-8);
    }
  }
}

TEST(Beam, under_an_end_force_bends_and_shears) {
  problem::Problem p = beam();
  const double F = 0.3;
  p.shell.loads.on_edges = {{.boundary = "right", .force = vector(0, 0, F), .couple = {}}};
  for (const ProbeValue& v : solve(p, MPI_COMM_SELF).probes) {
    const double x = v.values.x[0];
    EXPECT_NEAR(v.values.u[2], F * x * x * (3 * length - x) / (6 * bending_stiffness) + F * x / shear_stiffness, 1e-9)
        << v.name;
    EXPECT_NEAR(v.values.r[0], -F * x * (length - x / 2) / bending_stiffness, 1e-9);
    EXPECT_NEAR(v.values.Q[0], F, 1e-7);
    EXPECT_NEAR(v.values.M[0], -F * (length - x), 1e-7);
  }
}

TEST(Beam, under_an_end_pull_stretches) {
  problem::Problem p = beam();
  p.shell.loads.on_edges = {{.boundary = "right", .force = vector(5, 0, 0), .couple = {}}};
  for (const ProbeValue& v : solve(p, MPI_COMM_SELF).probes) {
    EXPECT_NEAR(v.values.u[0], 5 * v.values.x[0] / (E * thickness), 1e-12);
    EXPECT_NEAR(v.values.N[0], 5, 1e-9);
  }
}

TEST(Beam, that_is_turned_in_space_deflects_alike) {
  problem::Problem flat = beam(), turned = with_chart(beam(), {"c*x", "s*x", "y"}, {{"c", 0.6}, {"s", 0.8}});
  flat.shell.loads.on_edges = {{.boundary = "right", .force = vector(0.1, 0.2, 0.3), .couple = {}}};
  // x -> (c, s, 0), y -> e_z, a_3 = (s, -c, 0)
  turned.shell.loads.on_edges = {
      {.boundary = "right", .force = vector(0.1 * 0.6 + 0.3 * 0.8, 0.1 * 0.8 - 0.3 * 0.6, 0.2), .couple = {}}};
  const Result a = solve(flat, MPI_COMM_SELF), b = solve(turned, MPI_COMM_SELF);
  EXPECT_NEAR(a.summary.energy.total(), b.summary.energy.total(), 1e-10 * a.summary.energy.total());
  EXPECT_NEAR(a.probes[0].values.u.norm(), b.probes[0].values.u.norm(), 1e-10);
}

// ---- balance and certificate ---------------------------------------------------------------------------------------

std::vector<problem::Problem> shells() {
  std::vector<problem::Problem> all{cantilever_plate(), with_chart(cantilever_plate(), {"sin(x)", "y", "cos(x)"}),
                                    with_chart(cantilever_plate(), {"x", "y", "x^2 - y^2"}), pressed_strip(),
                                    pressed_bowl()};
  for (problem::Problem& p : all) p.discretisation.refinements = 1;
  return all;
}

TEST(Solution, balances_loads_with_supports_and_obstacle) {
  for (const problem::Problem& p : shells()) {
    const Result r = solve(p, MPI_COMM_SELF);
    ASSERT_EQ(r.status, Status::solved);
    const Vector3d sum = r.summary.loads.force + r.summary.support_reaction.force + r.summary.reaction.force;
    EXPECT_GT(r.summary.loads.force.norm(), 0);
    EXPECT_LT(sum.norm(), 1e-9 * r.summary.loads.force.norm());
    EXPECT_LT(r.certificate.force_balance, 1e-9);
    EXPECT_LT(r.certificate.moment_balance, 1e-3);  // falls with h on curved charts
  }
}

TEST(Solution, on_a_flat_plate_balances_moments_too) {
  EXPECT_LT(solve(cantilever_plate(), MPI_COMM_SELF).certificate.moment_balance, 1e-9);
}

TEST(Solution, satisfies_the_energy_identity) {
  for (const problem::Problem& p : shells()) {
    const Result r = solve(p, MPI_COMM_SELF);
    EXPECT_LT(r.certificate.energy_identity, 1e-8);
    EXPECT_LT(r.certificate.stationarity, 1e-8);
    EXPECT_GT(r.summary.energy.total(), 0);
    if (!p.shell.obstacles.empty()) continue;
    EXPECT_NEAR(2 * r.summary.energy.total(), r.summary.load_work, 1e-8 * r.summary.load_work);
  }
}

TEST(Solution, is_linear_in_the_load_where_there_is_no_obstacle) {
  problem::Problem once = cantilever_plate(), twice = cantilever_plate();
  once.probes = twice.probes = {{.name = "tip", .at = {1, 0.5}}};
  twice.shell.loads.on_areas.push_back(twice.shell.loads.on_areas[0]);
  const Result a = solve(once, MPI_COMM_SELF), b = solve(twice, MPI_COMM_SELF);
  EXPECT_LT((2 * a.probes[0].values.u - b.probes[0].values.u).norm(), 1e-10 * b.probes[0].values.u.norm());
  EXPECT_NEAR(4 * a.summary.energy.total(), b.summary.energy.total(), 1e-10 * b.summary.energy.total());
}

TEST(Contact, obeys_its_conditions_at_every_node) {  // g >= 0, eta >= 0, g eta = 0
  for (const problem::Problem& p : {pressed_strip(), pressed_bowl()}) {
    const Result r = solve(p, MPI_COMM_SELF);
    ASSERT_EQ(r.status, Status::solved);
    EXPECT_GT(r.summary.touching_nodes, 0);
    EXPECT_GT(r.summary.reaction.force[2], 0);
    const auto& discrete = r.solution->discrete;
    const auto& nodal = r.solution->nodal;
    double weighed = 0;
    for (std::size_t i = 0; i < discrete->points.size(); ++i) {
      const double* y = nodal.y.local().data() + 6 * i;
      const double g =
          discrete->coordinates.gaps[0][i](Eigen::Map<const Vector3d>(y), Eigen::Map<const Vector3d>(y + 3));
      EXPECT_GT(g, -1e-12);
      EXPECT_GE(nodal.pressure.local()[i], -1e-9 * r.summary.max_pressure);
      EXPECT_LT(std::abs(g * nodal.pressure.local()[i]), 1e-11 * r.summary.max_pressure);
      weighed += nodal.pressure.local()[i] * discrete->points[i].weight;
    }
    EXPECT_NEAR(weighed, r.summary.reaction.force[2], 1e-10 * weighed);  // the integral of the pressure is the reaction
  }
}

TEST(Contact, does_not_occur_under_a_load_that_lifts) {
  problem::Problem p = pressed_strip();
  p.shell.loads.on_areas = {force(0, 0, 4e-3)};
  const Result r = solve(p, MPI_COMM_SELF);
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_EQ(r.summary.touching_nodes, 0);
  p.shell.obstacles.all.clear();
  EXPECT_NEAR(solve(p, MPI_COMM_SELF).summary.energy.total(), r.summary.energy.total(),
              1e-12 * r.summary.energy.total());
}

TEST(Contact, on_the_upper_face_under_a_ceiling_mirrors_that_on_the_lower_face_over_a_table) {
  problem::Problem below = pressed_strip(),
                   above = with_chart(pressed_strip(), {"x", "y", "-0.01 - e/2"}, {{"e", 0.05}});
  above.shell.loads.on_areas = {force(0, 0, 4e-3)};
  above.shell.obstacles.all = {obstacle::Obstacle{
      .shape = obstacle::HalfSpace{.point = {0, 0, 0}, .normal = {0, 0, -1}}, .face = obstacle::Face::upper}};
  const Result a = solve(below, MPI_COMM_SELF), b = solve(above, MPI_COMM_SELF);
  EXPECT_EQ(a.summary.touching_nodes, b.summary.touching_nodes);
  EXPECT_NEAR(a.summary.energy.total(), b.summary.energy.total(), 1e-9 * a.summary.energy.total());
  EXPECT_NEAR(a.summary.reaction.force[2], -b.summary.reaction.force[2], 1e-9 * a.summary.reaction.force[2]);
}

// ---- outcomes ------------------------------------------------------------------------------------------------------

TEST(Outcome, of_a_plate_that_nothing_holds_is_singular) {
  problem::Problem p = free_plate();
  p.shell.loads.on_areas = {force(0, 0, -1)};
  const Result r = solve(p, MPI_COMM_SELF);
  EXPECT_EQ(r.status, Status::singular);
  EXPECT_EQ(r.levels.size(), 1u);  // no finer mesh would help
  p.shell.supports = {held("left", {Direction::x, Direction::y, Direction::z})};
  EXPECT_EQ(solve(p, MPI_COMM_SELF).status, Status::singular);
}

TEST(Outcome, of_a_plate_that_only_the_obstacle_holds_is_a_solution) {
  problem::Problem p = pressed_strip();
  p.shell.supports = {held("left", {Direction::x, Direction::y}), held("bottom", {Direction::y})};
  const Result r = solve(p, MPI_COMM_SELF);
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_NEAR(r.summary.reaction.force[2], 4e-3 * 0.125, 1e-9);
}

TEST(Outcome, of_an_edge_held_inside_of_the_obstacle_is_infeasible) {
  problem::Problem p = pressed_strip();
  std::get<obstacle::HalfSpace>(p.shell.obstacles.all.at(0).shape).point[2] = 0.02;
  const Result r = solve(p, MPI_COMM_SELF);
  EXPECT_EQ(r.status, Status::infeasible);
  EXPECT_EQ(r.levels.size(), 1u);
}

TEST(Outcome, of_too_few_iterations_says_so) {
  problem::Problem p = pressed_strip();
  p.contact.max_iterations = 1;
  EXPECT_EQ(solve(p, MPI_COMM_SELF).status, Status::iteration_limit);
}

TEST(Outcome, of_wrong_input_is_an_exception) {
  problem::Problem p = cantilever_plate();
  p.shell.supports.push_back(clamped("rim"));
  EXPECT_THROW(solve(p, MPI_COMM_SELF), assembly::SupportError);
  p = cantilever_plate();
  p.shell.supports.push_back(
      {.boundary = "bottom", .components = {fixed(Unknown::displacement, Direction::z, Expression(0.1))}});
  EXPECT_THROW(solve(p, MPI_COMM_SELF), assembly::SupportError);
  p = cantilever_plate();
  p.charts.clear();
  EXPECT_THROW(solve(p, MPI_COMM_SELF), mesh::DomainError);
  p = cantilever_plate();
  p.probes = {{.name = "out", .at = {2, 0}}};
  EXPECT_THROW(solve(p, MPI_COMM_SELF), mesh::DomainError);
}

// ---- probes and observers ------------------------------------------------------------------------------------------

TEST(Probe, holds_the_place_and_its_frame) {
  problem::Problem p = with_chart(cantilever_plate(), {"sin(x)", "y", "cos(x)"});
  p.probes = {{.name = "first", .at = {0.3, 0.7}}, {.name = "corner", .at = {1, 1}}};
  const Result r = solve(p, MPI_COMM_SELF);
  ASSERT_EQ(r.probes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(r.probes[i].name, p.probes[i].name);
    const auto& v = r.probes[i].values;
    EXPECT_LT((v.x - p.probes[i].at).norm(), 1e-12);
    const double x = p.probes[i].at[0], y = p.probes[i].at[1];
    EXPECT_LT((v.phi - Vector3d(std::sin(x), y, std::cos(x))).norm(), 1e-12);
    EXPECT_LT((v.t1 - Vector3d(std::cos(x), 0, -std::sin(x))).norm(), 1e-12);
    EXPECT_LT((v.a3 - v.t1.cross(v.t2)).norm(), 1e-12);
    EXPECT_NEAR(v.r.dot(v.a3), 0, 1e-2 * v.r.norm());  // tangent at nodes, nearly so between them
    EXPECT_TRUE(std::isnan(v.gap));
    EXPECT_EQ(v.thickness, 0.1);
  }
}

TEST(Observer, hears_the_phases_of_each_level_in_order) {
  std::vector<std::string> heard;
  problem::Problem p = pressed_strip();
  const Result r =
      solve(p, MPI_COMM_SELF,
            {.phase = [&](int level,
                          std::string_view name) { heard.push_back(std::to_string(level) + " " + std::string(name)); },
             .iteration =
                 [&](int level, const contact::Iteration&) {
                   const std::string step = std::to_string(level) + " iteration";
                   if (heard.back() != step) heard.push_back(step);
                 },
             .level = [&](int level, const Level&) { heard.push_back(std::to_string(level) + " done"); }});
  std::vector<std::string> expected;
  for (const std::string level : {"0 ", "1 "})
    for (const std::string what : {"geometry", "assembly", "analysis", "contact", "iteration", "certificate", "done"})
      expected.push_back(level + what);
  expected.insert(expected.end() - 1, "1 estimates");  // of the finest mesh only
  EXPECT_EQ(heard, expected);
  EXPECT_EQ(r.levels.size(), 2u);
}

TEST(Observer, hears_every_iteration_that_the_levels_record) {
  std::vector<int> steps(2);
  std::vector<std::int64_t> cells;
  const Result r =
      solve(pressed_bowl(), MPI_COMM_SELF,
            {.phase = {},
             .iteration = [&](int level, const contact::Iteration&) { ++steps[static_cast<std::size_t>(level)]; },
             .level = [&](int, const Level& l) { cells.push_back(l.cells); }});
  EXPECT_EQ(cells, (std::vector<std::int64_t>{5, 20}));
  for (std::size_t l = 0; l < 2; ++l) {
    EXPECT_EQ(r.levels[l].iterations, steps[l]);
    EXPECT_EQ(r.levels[l].history.size(), static_cast<std::size_t>(steps[l]));
    EXPECT_EQ(r.levels[l].unknowns, 5 * r.levels[l].nodes);
  }
}

/// Several active-set steps on each of four meshes.
problem::Problem pressed_in_several_steps() {
  problem::Problem p = pressed_strip();
  p.discretisation.refinements = 3;
  p.probes = {{.name = "middle", .at = {0.5, 0.0625}}};
  return p;
}

TEST(Interruption, leaves_the_result_of_the_last_mesh_that_was_finished) {
  const problem::Problem p = pressed_in_several_steps();
  const Result whole = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(whole.levels.size(), 4U);
  bool stop = false;
  Observer observer{.level = [&](int level, const Level&) { stop = level == 1; }, .stop = [&] { return stop; }};
  const Result stopped = solve(p, MPI_COMM_WORLD, observer);
  EXPECT_EQ(stopped.status, Status::interrupted);
  ASSERT_EQ(stopped.levels.size(), 2U);
  EXPECT_EQ(stopped.levels.back().status, Status::solved);
  EXPECT_DOUBLE_EQ(stopped.summary.energy.total(), whole.levels[1].energy);
  ASSERT_TRUE(stopped.solution);
  EXPECT_EQ(stopped.solution->discrete->space().global_cells, whole.levels[1].cells);
  EXPECT_EQ(stopped.probes.size(), p.probes.size());
}

TEST(Interruption, inside_of_a_mesh_drops_what_that_mesh_had) {
  problem::Problem p = pressed_bowl();
  p.discretisation.refinements = 3;
  std::size_t on = 0;  // the first finer mesh that takes several sets
  Observer observer{.iteration =
                        [&](int level, const contact::Iteration& set) {
                          if (on == 0 && set.changes > 0) on = static_cast<std::size_t>(level);
                        },
                    .stop = [&] { return on > 0; }};
  const Result stopped = solve(p, MPI_COMM_WORLD, observer);
  EXPECT_EQ(stopped.status, Status::interrupted);
  ASSERT_EQ(stopped.levels.size(), on);
  EXPECT_EQ(stopped.solution->discrete->space().global_cells, stopped.levels.back().cells);
}

TEST(Interruption, before_the_first_mesh_leaves_nothing) {
  const Result stopped = solve(pressed_in_several_steps(), MPI_COMM_WORLD, {.stop = [] { return true; }});
  EXPECT_EQ(stopped.status, Status::interrupted);
  EXPECT_TRUE(stopped.levels.empty());
  EXPECT_FALSE(stopped.solution);
}

}  // namespace
}  // namespace plastron::computation

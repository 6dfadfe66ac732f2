// Any number of ranks gives the same: all ranks together are compared with each rank alone.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>
#include <research/referees/solvers.hpp>

#include "algebra/mpi_calls.hpp"
#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;

void expect_near(double a, double b) { EXPECT_NEAR(a, b, 1e-9 * std::abs(b)); }
void expect_near(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double scale) {
  EXPECT_LE((a - b).norm(), 1e-9 * scale);
}

void expect_same_alone_and_together(problem::Problem p) {
  p.discretisation.refinements = 2;
  const Result alone = solve(p, MPI_COMM_SELF), together = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(alone.ranks, 1);
  ASSERT_EQ(alone.status, contact::Status::solved);
  ASSERT_EQ(together.status, contact::Status::solved);
  const auto &a = alone.summary, &b = together.summary;
  expect_near(b.energy.membrane, a.energy.membrane);
  expect_near(b.energy.bending, a.energy.bending);
  expect_near(b.energy.shear, a.energy.shear);
  expect_near(b.load_work, a.load_work);
  expect_near(b.reaction.force, a.reaction.force, a.loads.force.norm());
  expect_near(b.support_reaction.force, a.support_reaction.force, a.loads.force.norm());
  expect_near(b.contact_area, a.contact_area);
  expect_near(b.max_pressure, a.max_pressure);
  EXPECT_EQ(b.touching_nodes, a.touching_nodes);
  ASSERT_EQ(alone.levels.size(), together.levels.size());
  for (std::size_t l = 0; l < alone.levels.size(); ++l) {
    EXPECT_EQ(together.levels[l].nodes, alone.levels[l].nodes);
    EXPECT_EQ(together.levels[l].cells, alone.levels[l].cells);
    EXPECT_EQ(together.levels[l].active, alone.levels[l].active);
    EXPECT_EQ(together.levels[l].iterations, alone.levels[l].iterations);
    expect_near(together.levels[l].energy, alone.levels[l].energy);
  }
  for (std::size_t i = 0; i < alone.probes.size(); ++i) {
    expect_near(together.probes[i].values.u, alone.probes[i].values.u, 1e-2);
    expect_near(together.probes[i].values.r, alone.probes[i].values.r, 1e-1);
    EXPECT_NEAR(together.probes[i].values.pressure, alone.probes[i].values.pressure, 1e-8 * a.max_pressure);
  }
}

TEST(Ranks, do_not_change_a_pressed_strip) {
  problem::Problem p = pressed_strip();
  p.probes = {{.name = "middle", .at = {0.5, 0.06}}, {.name = "quarter", .at = {0.26, 0.03}}};
  expect_same_alone_and_together(p);
}

TEST(Ranks, do_not_change_a_pressed_bowl) {
  problem::Problem p = pressed_bowl();
  p.probes = {{.name = "middle", .at = {0, 0}}, {.name = "flank", .at = {0.2, 0.1}}};
  expect_same_alone_and_together(p);
}

TEST(Ranks, do_not_change_a_pressed_bowl_of_triangles) {
  for (int k = 1; k <= 2; ++k) {
    problem::Problem p = pressed_bowl();
    p.discretisation.cells = mesh::Shape::triangle;
    p.discretisation.degree = k;
    p.probes = {{.name = "middle", .at = {0, 0}}, {.name = "flank", .at = {0.2, 0.1}}};
    expect_same_alone_and_together(p);
  }
}

TEST(Ranks, do_not_change_a_pressed_bowl_in_any_formulation) {
  for (const auto formulation :
       {element::Formulation::penalised, element::Formulation::mixed, element::Formulation::classical}) {
    problem::Problem p = pressed_bowl();
    p.shell.tangency.formulation = formulation;
    expect_same_alone_and_together(p);
  }
}

// Some ranks then own no cells on the coarsest meshes, or cells but no nodes.
TEST(Ranks, may_outnumber_the_cells) {
  for (const int cells : {1, 2})
    for (const int degree : {1, 2}) {
      problem::Problem p = pressed_strip();
      std::get<domain::Rectangle>(p.domain).cells = {cells, 1};
      p.discretisation.degree = degree;
      expect_same_alone_and_together(p);
    }
}

// Proportioning applies operators hundreds of times, the active set about ten times.
TEST(Ranks, plan_their_exchanges_for_meshes_and_not_for_steps_of_solvers) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const auto plans = [](contact::SolverFunction* solver) {
    problem::Problem p = pressed_bowl();
    p.discretisation.refinements = 2;
    p.contact.solver = solver;
    const test::Calls calls;
    EXPECT_EQ(solve(p, MPI_COMM_WORLD).status, contact::Status::solved);
    EXPECT_EQ(calls.freed(), calls.graphs());
    return calls.graphs();
  };
  const int by_active_set = plans(nullptr);
  EXPECT_EQ(by_active_set > 0, ranks > 1);
  EXPECT_EQ(plans(referees::solve_mprgp), by_active_set);
}

TEST(Ranks, find_the_same_when_they_examine) {
  for (const problem::Problem& p : {pressed_strip(), free_plate()}) {
    std::int64_t found = static_cast<std::int64_t>(examination::examine(p).size());
    const std::int64_t here = found;
    MPI_Bcast(&found, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
    EXPECT_EQ(found, here);
  }
}

TEST(Ranks, all_say_that_a_problem_has_no_solution) {
  problem::Problem p = free_plate();
  p.shell.loads.on_areas = {force(0, 0, -1)};
  EXPECT_EQ(solve(p, MPI_COMM_WORLD).status, contact::Status::singular);
  p = pressed_strip();
  std::get<obstacle::HalfSpace>(p.shell.obstacles.all.at(0).shape).point[2] = 0.02;
  EXPECT_EQ(solve(p, MPI_COMM_WORLD).status, contact::Status::infeasible);
}

TEST(Ranks, all_stop_when_one_is_asked_to) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  bool stop = false;
  const Observer observer{.level = [&](int level, const Level&) { stop = level == 0 && rank == ranks - 1; },
                          .stop = [&] { return stop; }};
  const Result result = solve(pressed_strip(), MPI_COMM_WORLD, observer);
  EXPECT_EQ(result.status, contact::Status::interrupted);
  EXPECT_EQ(result.levels.size(), 1U);
}

TEST(Ranks, all_throw_for_a_probe_outside) {
  problem::Problem p = cantilever_plate();
  p.probes = {{.name = "out", .at = {2, 0}}};
  EXPECT_THROW(solve(p, MPI_COMM_WORLD), mesh::DomainError);
}

TEST(Ranks, all_throw_for_a_load_that_is_not_finite_on_one) {
  problem::Problem p = cantilever_plate();
  p.shell.loads.on_areas[0].pressure = Expression("x > 0.9 && y > 0.9 ? log(-x) : 1", {});
  EXPECT_THROW(solve(p, MPI_COMM_WORLD), energy::LoadError);
}

TEST(Ranks, divide_cells_alike_where_a_load_jumps) {
  problem::Problem p = cantilever_plate();
  p.shell.loads.on_areas[0].pressure = Expression("x + y > 0.87 ? 1 : 0", {});
  p.shell.loads.on_edges = {{.boundary = "right", .force = vector(0, 0, 0), .couple = {}}};
  p.shell.loads.on_edges[0].force[2] = Expression("max(y - 0.3, 0)", {});
  expect_same_alone_and_together(p);
}

}  // namespace
}  // namespace plastron::computation

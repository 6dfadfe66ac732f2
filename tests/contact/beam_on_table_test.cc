// A beam clamped at both ends and pressed on a table below it. It lies flat in the middle, and the free boundary
// carries point reactions. This is the model problem of thin structures in contact.
#include <plastron/algebra/factorisation.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/contact/subproblem.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algebra/beam.hpp"

namespace plastron::test {
namespace {

using contact::Activity;
using contact::BoxProblem;
using contact::Status;

constexpr double infinity = std::numeric_limits<double>::infinity();

// The table is at -1; the load presses the middle third of the beam onto it.
struct BeamOnTable {
  explicit BeamOnTable(GlobalIndex nodes, MPI_Comm comm = MPI_COMM_WORLD)
      : beam(nodes, 0, comm),
        problem{.matrix = beam.matrix,
                .apply = [this](const Vector& z, Vector& y) { beam.apply(z, y); },
                .load = Vector(beam.layout, 1),
                .lower = Vector(beam.layout, 1),
                .upper = Vector(beam.layout, 1)},
        factorisation(beam.matrix) {
    const double load = -3000 * std::pow(1.0 / static_cast<double>(nodes), 4);
    problem.load.fill(load);
    problem.lower.fill(-1);
    problem.upper.fill(infinity);
    const auto clamped = beam.ends(2);
    for (std::size_t i = 0; i < clamped.size(); ++i)
      if (clamped[i]) problem.lower.owned()[i] = problem.upper.owned()[i] = 0;
  }
  BeamOnTable(const BeamOnTable&) = delete;
  BeamOnTable& operator=(const BeamOnTable&) = delete;

  Beam beam;
  BoxProblem problem;
  algebra::Factorisation factorisation;
};

TEST(BeamOnTable, is_solved_alike_by_all_solvers) {
  BeamOnTable table(61);
  const auto plain = contact::solve_primal_dual_active_set(table.problem, {}, table.factorisation);
  const auto search = contact::solve_projected_search(table.problem, {}, table.factorisation);
  ASSERT_EQ(plain.status, Status::solved);
  ASSERT_EQ(search.status, Status::solved);
  const auto a = gather(plain.z);
  const auto b = gather(search.z);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9);
  EXPECT_GT(plain.iterations.back().active, 8);
  EXPECT_NEAR(plain.iterations.back().energy, search.iterations.back().energy,
              1e-10 * std::abs(plain.iterations.back().energy));
}

TEST(BeamOnTable, is_checked_by_one_solve_from_its_own_active_set) {
  BeamOnTable table(61);
  const auto cold = contact::solve_primal_dual_active_set(table.problem, {}, table.factorisation);
  const auto warm = contact::solve_primal_dual_active_set(table.problem, cold.activity, table.factorisation);
  ASSERT_EQ(warm.status, Status::solved);
  EXPECT_EQ(warm.iterations.size(), 1u);
  EXPECT_GT(cold.iterations.size(), 5u);
  EXPECT_EQ(gather(warm.z), gather(cold.z));
}

TEST(BeamOnTable, keeps_its_factor_while_few_unknowns_change_if_told_to) {
  BeamOnTable table(61);
  const auto afresh = contact::solve_primal_dual_active_set(table.problem, {}, table.factorisation);
  const int factorisations = table.factorisation.factorisations();
  EXPECT_EQ(factorisations, static_cast<int>(afresh.iterations.size()));
  const auto kept =
      contact::solve_primal_dual_active_set(table.problem, {}, table.factorisation,
                                            {.detect_free_motions = false, .kept_factor = contact::KeptFactor::always});
  EXPECT_LT(table.factorisation.factorisations() - factorisations, factorisations / 2);
  ASSERT_EQ(kept.status, Status::solved);
  EXPECT_EQ(kept.activity, afresh.activity);
  EXPECT_EQ(kept.iterations.size(), afresh.iterations.size());
  const auto a = gather(kept.z);
  const auto b = gather(afresh.z);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-10);
}

TEST(BeamOnTable, is_factorised_anew_in_every_step_because_that_is_cheaper) {
  BeamOnTable table(61);
  const auto z =
      contact::solve_primal_dual_active_set(table.problem, {}, table.factorisation, {.detect_free_motions = false});
  EXPECT_EQ(table.factorisation.factorisations(), static_cast<int>(z.iterations.size()));
}

// Counts and times of the cap of benchmarks/step_cost at degree 4: a factorisation takes as long as 10.0, 9.5 and 13.2 steps.
TEST(KeptFactor, affords_the_steps_that_were_measured) {
  EXPECT_NEAR(contact::affordable_steps(algebra::price_of({.operations = 1.25e9, .entries = 4.53e6}), 25925), 10, 3);
  EXPECT_NEAR(contact::affordable_steps(algebra::price_of({.operations = 1.01e10, .entries = 2.19e7}), 103045), 10, 2);
  EXPECT_NEAR(contact::affordable_steps(algebra::price_of({.operations = 8.03e10, .entries = 1.03e8}), 410885), 13, 2);
}

TEST(KeptFactor, is_tried_where_fewer_unknowns_changed_than_steps_are_affordable) {
  using contact::KeptFactor;
  const algebra::Price cost = algebra::price_of({.operations = 8.03e10, .entries = 1.03e8});
  EXPECT_GT(contact::steps_to_try(KeptFactor::where_cheaper, cost, 410885, 4), 4);
  EXPECT_EQ(contact::steps_to_try(KeptFactor::where_cheaper, cost, 410885, 40), 0);
  EXPECT_GT(contact::steps_to_try(KeptFactor::always, cost, 410885, 40), 0);
}

TEST(BeamOnTable, takes_few_steps_from_the_active_set_of_half_as_many_nodes) {
  const GlobalIndex coarse_nodes = 51;
  BeamOnTable coarse(coarse_nodes);
  BeamOnTable fine(2 * coarse_nodes - 1);
  const auto coarse_solution = contact::solve_primal_dual_active_set(coarse.problem, {}, coarse.factorisation);
  const auto touches = gather(vector_of(coarse.beam.layout, 1, [&](GlobalIndex i) {
    const auto k = static_cast<std::size_t>(i - coarse.beam.layout->first);
    return coarse_solution.activity[k] == Activity::at_lower ? 1.0 : 0.0;
  }));
  std::vector<Activity> initial(fine.problem.load.owned().size(), Activity::free);
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const std::size_t k = static_cast<std::size_t>(fine.beam.layout->first) + i;
    if (touches[k / 2] > 0 && touches[(k + 1) / 2] > 0) initial[i] = Activity::at_lower;
  }
  const auto warm = contact::solve_primal_dual_active_set(fine.problem, initial, fine.factorisation);
  const auto cold = contact::solve_primal_dual_active_set(fine.problem, {}, fine.factorisation);
  ASSERT_EQ(warm.status, Status::solved);
  EXPECT_LE(warm.iterations.size(), 6u);
  EXPECT_LT(warm.iterations.size(), cold.iterations.size());
}

TEST(BeamOnTable, gives_the_same_numbers_on_every_number_of_ranks) {
  BeamOnTable spread(60);
  BeamOnTable alone(60, MPI_COMM_SELF);
  const auto a = contact::solve_primal_dual_active_set(spread.problem, {}, spread.factorisation);
  const auto b = contact::solve_primal_dual_active_set(alone.problem, {}, alone.factorisation);
  ASSERT_EQ(a.status, Status::solved);
  ASSERT_EQ(a.iterations.size(), b.iterations.size());
  for (std::size_t k = 0; k < a.iterations.size(); ++k) {
    EXPECT_EQ(a.iterations[k].active, b.iterations[k].active);
    EXPECT_EQ(a.iterations[k].changes, b.iterations[k].changes);
    EXPECT_NEAR(a.iterations[k].energy, b.iterations[k].energy, 1e-10 * std::abs(b.iterations[k].energy));
  }
  const auto u = gather(a.z);
  const auto v = gather(b.z);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], v[i], 1e-10);
}

TEST(BeamOnTable, is_in_equilibrium) {
  BeamOnTable table(61);
  const auto solution = contact::solve_primal_dual_active_set(table.problem, {}, table.factorisation);
  double forces = 0;
  for (std::size_t i = 0; i < solution.activity.size(); ++i)
    forces += solution.multiplier.owned()[i] + table.problem.load.owned()[i];
  const double load = std::abs(61 * table.problem.load.owned()[0]);
  EXPECT_NEAR(algebra::sum_over_ranks(forces, MPI_COMM_WORLD), 0, 1e-9 * load);
}

}  // namespace
}  // namespace plastron::test

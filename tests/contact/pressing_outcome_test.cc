// A pressing force and its position, the outcomes of a search for positions, and the cost of a step.
#include <plastron/contact/border.hpp>
#include <plastron/contact/pressing.hpp>

#include <gtest/gtest.h>

#include "algebra/beam.hpp"
#include "contact/pressed_problem.hpp"

namespace plastron::test {
namespace {

using contact::Activity;
using contact::Status;

/// A clamped beam, and above it a round punch with its tip at the middle, 0.5 away.
struct PunchedBeam {
  explicit PunchedBeam(double force, GlobalIndex nodes = 31)
      : beam(nodes),
        problem{.matrix = beam.matrix,
                .apply = [this](const Vector& z, Vector& y) { beam.apply(z, y); },
                .load = Vector(beam.layout, 1),
                .lower = Vector(beam.layout, 1),
                .upper = vector_of(beam.layout, 1,
                                   [nodes](GlobalIndex i) {
                                     const double x = 2 * static_cast<double>(i) / static_cast<double>(nodes - 1) - 1;
                                     return 0.5 + x * x;
                                   })},
        factorisation(beam.matrix) {
    contact::PressingForce punch{.lower_shape = Vector(beam.layout, 1),
                                 .upper_shape = Vector(beam.layout, 1),
                                 .force = force * std::pow(static_cast<double>(nodes), -3.0)};
    problem.lower.fill(-no_bound);
    punch.upper_shape.fill(-1);
    const auto clamped = beam.ends(2);
    for (std::size_t i = 0; i < clamped.size(); ++i) {
      if (!clamped[i]) continue;
      problem.lower.owned()[i] = problem.upper.owned()[i] = 0;
      punch.upper_shape.owned()[i] = 0;
    }
    problem.pressing.push_back(std::move(punch));
  }
  PunchedBeam(const PunchedBeam&) = delete;
  PunchedBeam& operator=(const PunchedBeam&) = delete;

  contact::BoxSolution solve(contact::SolverFunction& solver = contact::solve_primal_dual_active_set,
                             std::span<const Activity> initial = {}, const contact::Settings& settings = {},
                             const contact::Observer& observer = {}) {
    return solver(problem, initial, factorisation, settings, observer);
  }

  Beam beam;
  contact::BoxProblem problem;
  algebra::Factorisation factorisation;
};

TEST(PressingForce, moves_further_the_greater_it_is) {
  double last = 0.5, work_by_curve = 0, last_force = 0;
  for (double force = 20; force < 3000; force *= ranks() == 1 ? 1.5 : 6) {
    PunchedBeam punched(force);
    const auto solution = punched.solve();
    ASSERT_EQ(solution.status, Status::solved);
    EXPECT_GT(solution.positions[0], last);
    const double newtons = punched.problem.pressing[0].force;
    work_by_curve += 0.5 * (newtons + last_force) * (solution.positions[0] - last);
    last = solution.positions[0];
    last_force = newtons;
    const double stored = solution.iterations.back().energy + newtons * last;
    if (ranks() > 1) continue;                          // too few points
    EXPECT_NEAR(stored, work_by_curve, 0.05 * stored);  // the area under the curve, by trapezoids
  }
}

TEST(PressingForce, and_its_position_prescribed_give_the_same_solution) {
  for (const double force : {5.0, 2000.0}) {
    PunchedBeam pressed(force);
    const auto by_force = pressed.solve();
    ASSERT_EQ(by_force.status, Status::solved);
    const contact::BoxProblem moved = contact::at_positions(pressed.problem, by_force.positions);
    const auto by_position = contact::solve_primal_dual_active_set(moved, {}, pressed.factorisation);
    ASSERT_EQ(by_position.status, Status::solved);
    EXPECT_LT((gathered(by_force.z) - gathered(by_position.z)).cwiseAbs().maxCoeff(), 1e-9);
    // and back: pressed with the reaction that was found
    const double reaction = contact::reactions(pressed.problem, by_position.multiplier, by_position.activity)[0];
    EXPECT_NEAR(reaction, pressed.problem.pressing[0].force, 1e-8 * reaction);
    pressed.problem.pressing[0].force = reaction;
    const auto back = pressed.solve();
    ASSERT_EQ(back.status, Status::solved);
    EXPECT_NEAR(back.positions[0], by_force.positions[0], 1e-8);
  }
}

TEST(EverySolver, presses_a_punch_on_a_beam_alike) {
  PunchedBeam punched(800);
  const auto plain = punched.solve();
  ASSERT_EQ(plain.status, Status::solved);
  EXPECT_GT(plain.iterations.back().active, 2);
  for (const NamedSolver& solver : solvers()) {
    SCOPED_TRACE(solver.name);
    const auto other = punched.solve(*solver.solve);
    ASSERT_EQ(other.status, Status::solved);
    EXPECT_NEAR(other.positions[0], plain.positions[0], 1e-8);
    EXPECT_NEAR(contact::reactions(punched.problem, other.multiplier, other.activity)[0],
                punched.problem.pressing[0].force, 1e-10 * punched.problem.pressing[0].force);
  }
}

TEST(PressingForce, costs_one_factorisation_a_step_whatever_the_rule_of_the_kept_factor) {
  for (const auto rule : {contact::KeptFactor::where_cheaper, contact::KeptFactor::always}) {
    PunchedBeam punched(800);
    const auto cold =
        punched.solve(contact::solve_primal_dual_active_set, {}, {.detect_free_motions = false, .kept_factor = rule});
    ASSERT_EQ(cold.status, Status::solved);
    EXPECT_GT(cold.iterations.size(), 3U);
    EXPECT_EQ(punched.factorisation.factorisations(), static_cast<int>(cold.iterations.size()));
    const auto warm = punched.solve(contact::solve_primal_dual_active_set, cold.activity);
    ASSERT_EQ(warm.status, Status::solved);
    EXPECT_EQ(warm.iterations.size(), 1U);
    EXPECT_NEAR(warm.positions[0], cold.positions[0], 1e-12);
  }
}

std::vector<Status> outcomes(const PressedDense& dense, const contact::Settings& settings = {}) {
  const DistributedPressed pressed(dense);
  algebra::Factorisation F(pressed.matrix());
  std::vector<Status> all;
  for (const NamedSolver& solver : solvers())
    all.push_back(solve_with(solver, pressed.problem(), F, {}, settings).status);
  return all;
}

/// A row of springs, the first one fixed if `is_held`. A punch is above the last one.
PressedDense punched_springs(Eigen::Index n, bool is_held, double shape) {
  PressedDense dense{.box = {.A = Eigen::MatrixXd::Zero(n, n),
                             .b = Eigen::VectorXd::Zero(n),
                             .lower = Eigen::VectorXd::Constant(n, -no_bound),
                             .upper = Eigen::VectorXd::Constant(n, no_bound)},
                     .lower_shape = Eigen::MatrixXd::Zero(n, 1),
                     .upper_shape = Eigen::MatrixXd::Zero(n, 1),
                     .force = Eigen::VectorXd::Constant(1, 2.0)};
  for (Eigen::Index i = 0; i + 1 < n; ++i) dense.box.A.block(i, i, 2, 2) += Eigen::Matrix2d{{3, -3}, {-3, 3}};
  if (is_held) dense.box.lower(0) = dense.box.upper(0) = 0;
  dense.box.upper(n - 1) = 1;
  dense.upper_shape(n - 1, 0) = shape;
  return dense;
}

TEST(EverySolver, says_that_nothing_carries_a_force_that_pulls_away_or_finds_nothing) {
  for (const Status status : outcomes(punched_springs(5, true, 1))) EXPECT_EQ(status, Status::not_carried);
  PressedDense beside = punched_springs(5, true, -1);
  beside.box.upper(4) = no_bound;
  for (const Status status : outcomes(beside)) EXPECT_EQ(status, Status::not_carried);
  for (const Status status : outcomes(punched_springs(5, true, -1))) EXPECT_EQ(status, Status::solved);
}

TEST(EverySolver, calls_a_structure_that_nothing_holds_against_a_force_singular) {
  for (const Status status : outcomes(punched_springs(5, false, -1))) EXPECT_EQ(status, Status::singular);
}

TEST(EverySolver, calls_bounds_that_forces_press_on_each_other_infeasible) {
  PressedDense pinched = punched_springs(5, true, -1);
  pinched.box.lower(4) = -0.25;  // the springs alone would give way by 8/3
  for (const Status status : outcomes(pinched)) EXPECT_EQ(status, Status::infeasible);
  pinched.box.lower(4) = -2.7;
  for (const Status status : outcomes(pinched)) EXPECT_EQ(status, Status::solved);
}

TEST(EverySolver, stops_pressing_at_the_iteration_limit_or_when_asked) {
  for (const Status status : outcomes(random_pressed(12, 1, 2), {.max_iterations = 1}))
    EXPECT_EQ(status, Status::iteration_limit);
  for (const NamedSolver& solver : solvers()) {
    PunchedBeam punched(800);
    std::size_t seen = 0;
    const contact::Observer first_only{.iteration = [&](const contact::Iteration&) { ++seen; },
                                       .stop = [] { return true; }};
    const auto stopped = punched.solve(*solver.solve, {}, {}, first_only);
    EXPECT_EQ(stopped.status, Status::interrupted) << solver.name;
    EXPECT_EQ(seen, stopped.iterations.size()) << solver.name;
    EXPECT_EQ(seen, 1U) << solver.name;
  }
}

// The four unknowns z >= 0 of safeguard_test.cc on which the plain method cycles from an empty active set, and a separate pressed one.
TEST(PrimalDualActiveSet, hands_over_to_the_pressing_search_where_it_would_cycle) {
  PressedDense dense{.box = {.A = Eigen::MatrixXd::Identity(5, 5),
                             .b = Eigen::VectorXd{{-7, 7, 8, -4, 0}},
                             .lower = Eigen::VectorXd::Zero(5),
                             .upper = Eigen::VectorXd::Constant(5, no_bound)},
                     .lower_shape = Eigen::MatrixXd::Zero(5, 1),
                     .upper_shape = Eigen::MatrixXd::Zero(5, 1),
                     .force = Eigen::VectorXd::Constant(1, 2.0)};
  dense.box.A.topLeftCorner(4, 4) << 23, 6, -18, -16, 6, 14, -1, -10, -18, -1, 19, 12, -16, -10, 12, 17;
  dense.lower_shape(4, 0) = 0.5;
  const auto exact = brute_force(dense);
  ASSERT_TRUE(exact);
  const DistributedPressed pressed(dense);
  algebra::Factorisation F(pressed.matrix());
  const auto solution = contact::solve_primal_dual_active_set(pressed.problem(), {}, F);
  ASSERT_EQ(solution.status, Status::solved);
  EXPECT_FALSE(solution.iterations.front().safeguarded);
  EXPECT_TRUE(solution.iterations.back().safeguarded);
  EXPECT_LT((gathered(solution.z) - exact->z).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_NEAR(solution.positions[0], 8, 1e-10);
}

TEST(Border, solves_and_tells_a_motion_that_costs_nothing) {
  contact::SmallMatrix K(2), none(2);
  K.values = {4, 2, 2, 3};
  const auto border = contact::Border::of(K, none, none);
  ASSERT_TRUE(border.free_motion().empty());
  const auto x = border.solve(std::vector<double>{8, 8});
  EXPECT_NEAR(x[0], 1, 1e-14);
  EXPECT_NEAR(x[1], 2, 1e-14);
  const auto nearest = border.nearest(x, {{1, 1}}, std::vector<double>{1});
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->x[0] + nearest->x[1], 1, 1e-14);
  EXPECT_NEAR(nearest->multipliers[0] - (8 - 4 * nearest->x[0] - 2 * nearest->x[1]), 0, 1e-13);
  K.values = {4, 2, 2, 1};
  const auto motion = contact::Border::of(K, none, none).free_motion();
  ASSERT_EQ(motion.size(), 2U);
  EXPECT_NEAR(motion[0], -0.5 * motion[1], 1e-14);
}

}  // namespace
}  // namespace plastron::test

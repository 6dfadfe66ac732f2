// Lifted bounds move the solution on its active set. Their estimates are differences of goals of shells with and without lifts.
#include <gtest/gtest.h>
#include <plastron/domain/domain.hpp>
#include <plastron/estimation/lifted_bounds.hpp>

#include <cmath>
#include <numeric>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "estimation/solved_shell.hpp"

namespace plastron::estimation::lifted_bounds_test {
namespace {

using plastron::test::MeshedSurface;
using plastron::test::SolvedShell;

struct Shell {
  std::string name;
  int degree = 2;
  mesh::Shape cells = mesh::Shape::quadrilateral;
  element::Formulation formulation = element::Formulation::tangent;
  bool is_pressed = false;
};
void PrintTo(const Shell& shell, std::ostream* out) { *out << shell.name; }

/// A saddle that sags on a table, or on which a force presses the table from below.
class Saddle {
 public:
  explicit Saddle(const Shell& given)
      : mesh_(plastron::test::meshed(domain::Rectangle{.cells = {4, 4}}, plastron::test::saddle, given.degree, 0,
                                     given.cells)) {
    energy::AreaLoad load{};
    load.force = {geometry::Expression(0.005), geometry::Expression(0.0), geometry::Expression(-0.02)};
    shell_ = {.sections = plastron::test::steel_of(geometry::Expression(0.1)),
              .supports = {plastron::test::clamp("left"), plastron::test::clamp("right")},
              .loads = {.on_areas = {load}}};
    shell_.tangency.formulation = given.formulation;
    obstacle::Obstacle table{};
    table.placement.translation = {0, 0, 0.3};
    if (given.is_pressed) table.force = {0, 0, 5e-3};
    shell_.obstacles.all = {table};
  }

  SolvedShell solved() const { return {mesh_, shell_}; }
  /// With random lifts of all nodes up to this size.
  SolvedShell lifted(double most, int seed) const {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> lift(0, most);
    assembly::State state;
    state.lifts = algebra::Vector(mesh_.space->layout, 1);
    for (double& value : state.lifts.owned()) value = lift(random);
    state.lifts.update_ghosts();
    return {mesh_, shell_, std::move(state)};
  }

 private:
  MeshedSurface mesh_;
  assembly::ShellDescription shell_;
};

std::vector<Functional> goals(bool is_pressed) {
  std::vector<Functional> all{LoadWork{},
                              ObstacleForce{.obstacle = 0},
                              ObstacleForce{.component = 2},
                              SupportForce{.component = 2},
                              SupportForce{.boundary = "left", .component = 0},
                              PointDisplacement{{0.52, 0.37}, 2},
                              PointDisplacement{{0.3, 0.8}, 4},
                              PointStress{.at = {0.52, 0.37}, .component = 3}};
  if (is_pressed) all.emplace_back(ObstaclePosition{0});
  return all;
}

class LiftsOf : public testing::TestWithParam<Shell> {};
INSTANTIATE_TEST_SUITE_P(
    Each, LiftsOf,
    testing::Values(Shell{"degree 1", 1}, Shell{"degree 2"}, Shell{"degree 4", 4},
                    Shell{"triangles", 2, mesh::Shape::triangle},
                    Shell{"triangles, degree 1", 1, mesh::Shape::triangle},
                    Shell{"penalised", 2, mesh::Shape::quadrilateral, element::Formulation::penalised},
                    Shell{"mixed", 2, mesh::Shape::quadrilateral, element::Formulation::mixed},
                    Shell{"classical", 2, mesh::Shape::quadrilateral, element::Formulation::classical},
                    Shell{"pressed", 2, mesh::Shape::quadrilateral, element::Formulation::tangent, true},
                    Shell{"pressed, mixed", 3, mesh::Shape::quadrilateral, element::Formulation::mixed, true}));

bool relaxes_tangency(const Shell& shell) {
  return shell.formulation == element::Formulation::penalised || shell.formulation == element::Formulation::mixed;
}

double sum_of(const std::vector<double>& shares) { return std::accumulate(shares.begin(), shares.end(), 0.0); }

TEST_P(LiftsOf, EstimateTheDifferenceToTheSolutionWithoutThem) {
  constexpr double size = 1e-7;
  const Saddle saddle(GetParam());
  const SolvedShell without = saddle.solved();
  for (const int seed : {1, 2}) {
    SolvedShell lifted = saddle.lifted(size, seed);
    ASSERT_EQ(lifted.solution().activity, without.solution().activity);
    const Solved solved = lifted.solved();
    const LiftedBounds lifts(solved);
    ASSERT_TRUE(lifts.any());
    for (const Functional& goal : goals(GetParam().is_pressed)) {
      const auto dual = lifted.dual(goal);
      if (!dual) {  // (M13) is stiff: some of its linear equations miss their tolerance
        EXPECT_EQ(GetParam().formulation, element::Formulation::penalised) << goal.index();
        continue;
      }
      const double difference = without.value(goal) - lifted.value(goal);
      EXPECT_NEAR(sum_of(lifts.shares(dual->multiplier)), difference,
                  1e-3 * std::abs(difference) + 1e-9 * std::abs(lifted.value(goal)))
          << goal.index();
    }
  }
}

// The energy is quadratic in the lifts: its estimate holds for large ones, too, as long as the active set stays.
TEST_P(LiftsOf, EstimateTheEnergy) {
  const Saddle saddle(GetParam());
  const SolvedShell without = saddle.solved();
  for (const double size : {1e-7, 1e-5}) {
    SolvedShell lifted = saddle.lifted(size, 3);
    if (lifted.solution().activity != without.solution().activity) {
      EXPECT_GT(size, 1e-6);
      continue;
    }
    const Solved solved = lifted.solved();
    const LiftedBounds lifts(solved);
    const auto dual = lifted.dual(Functional(Energy{})), back = lifted.dual(lifts.way_back());
    ASSERT_TRUE(dual && back);
    algebra::Vector y(back->z.layout(), 6);
    lifted.discrete().coordinates.to_cartesian(back->z, y);
    const double estimate = sum_of(lifts.shares(dual->multiplier)) + lifted.discrete().motion_energies(y).total();
    const double difference = without.value(Energy{}) - lifted.value(Energy{});
    EXPECT_GT(std::abs(difference), 1e-9 * lifted.value(Energy{}));
    // The stored energy has no part of the forms (M13) and (M14), which move the solution.
    EXPECT_NEAR(estimate, difference, (relaxes_tangency(GetParam()) ? 0.25 : 1e-2) * std::abs(difference));
  }
}

TEST_P(LiftsOf, AreInTheErrorsOfGoalsAndInTheirCells) {
  const Saddle saddle(GetParam());
  SolvedShell without = saddle.solved(), lifted = saddle.lifted(1e-3, 4);
  const std::vector<Goal> all{{"energy", Energy{}}, {"work", LoadWork{}}, {"u", PointDisplacement{{0.52, 0.37}, 2}}};
  const Estimates estimates = lifted.estimates(all);
  for (std::size_t g = 0; g < all.size(); ++g) {
    const double change = std::abs(without.value(all[g].functional) - lifted.value(all[g].functional));
    EXPECT_GT(change, 1e-4 * std::abs(lifted.value(all[g].functional)));
    EXPECT_GT(estimates.goals[g].error(), change / 2) << all[g].name;
    double in_cells = 0;
    for (const double share : estimates.goals[g].cells) in_cells += std::abs(share);
    EXPECT_GT(in_cells, change / 2) << all[g].name;
  }
}

TEST(NoLifts, ChangeNothing) {
  const SolvedShell shell = Saddle({"degree 2"}).solved();
  const Solved solved = shell.solved();
  const LiftedBounds lifts(solved);
  EXPECT_FALSE(lifts.any());
  EXPECT_EQ(sum_of(lifts.shares(shell.solution().multiplier)), 0);
}

}  // namespace
}  // namespace plastron::estimation::lifted_bounds_test

// A string pressed on a table from a cold start. The plain iteration gives back one node per step at each end of the zone, which
// is 240 nodes too long at first. A first solution with few of the bounds takes few steps.
#include <gtest/gtest.h>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/contact/solve.hpp>

#include <cmath>
#include <limits>

#include "algebra/chain.hpp"

namespace plastron::test {
namespace {

using contact::Activity;
using contact::Status;

/// -u'' = -p on (0, 1), u = 0 at both ends, u >= -1: it leaves the table at a with p a^2 / 2 = 1.
struct StringOnTable {
  static constexpr double p = 100;

  explicit StringOnTable(GlobalIndex nodes)
      : elements(chain(nodes)),
        layout(layout_for(nodes, elements)),
        own(connectivity(*layout, elements)),
        matrix(layout, 1, own),
        h(1 / static_cast<double>(nodes - 1)) {
    for (std::size_t k = 0; k < own.elements(); ++k)
      matrix.add(own.element(k), std::vector<double>{1 / h, -1 / h, -1 / h, 1 / h});
    matrix.finish();
    for (std::size_t i = 0; i < problem.lower.owned().size(); ++i) {
      const GlobalIndex node = layout->first + static_cast<GlobalIndex>(i);
      const bool is_end = node == 0 || node == nodes - 1;
      problem.load.owned()[i] = -p * h;
      problem.lower.owned()[i] = is_end ? 0 : -1;
      problem.upper.owned()[i] = is_end ? 0 : std::numeric_limits<double>::infinity();
    }
  }
  StringOnTable(const StringOnTable&) = delete;
  StringOnTable& operator=(const StringOnTable&) = delete;

  void apply(const Vector& z, Vector& y) const {
    y.fill(0.0);
    for (std::size_t k = 0; k < own.elements(); ++k) {
      const auto left = static_cast<std::size_t>(own.element(k)[0]),
                 right = static_cast<std::size_t>(own.element(k)[1]);
      const double pull = (z.local()[right] - z.local()[left]) / h;
      y.local()[left] -= pull;
      y.local()[right] += pull;
    }
    y.accumulate_ghosts();
  }

  Elements elements;
  std::shared_ptr<const Layout> layout;
  Connectivity own;
  Matrix matrix;
  double h;
  contact::BoxProblem problem{.matrix = matrix,
                              .apply = [this](const Vector& z, Vector& y) { apply(z, y); },
                              .load = Vector(layout, 1),
                              .lower = Vector(layout, 1),
                              .upper = Vector(layout, 1)};
};

TEST(ColdStart, takes_few_steps_to_a_zone_that_is_hundreds_of_rows_too_large_at_first) {
  constexpr GlobalIndex nodes = 2001;
  StringOnTable table(nodes);
  algebra::Factorisation factorisation(table.matrix);
  const auto solution = contact::solve_primal_dual_active_set(table.problem, {}, factorisation);
  ASSERT_EQ(solution.status, Status::solved);
  EXPECT_LE(solution.iterations.size(), 60u);
  for (const contact::Iteration& i : solution.iterations) EXPECT_FALSE(i.safeguarded);
  const double free_length = std::sqrt(2 / StringOnTable::p);
  EXPECT_NEAR(static_cast<double>(solution.iterations.back().active), (1 - 2 * free_length) / table.h, 2);
  const auto u = gather(solution.z);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double x = std::min(table.h * static_cast<double>(i), 1 - table.h * static_cast<double>(i));
    const double from_edge = std::max(0.0, free_length - x);
    EXPECT_NEAR(u[i], -1 + StringOnTable::p / 2 * from_edge * from_edge, 1e-4);
  }
}

TEST(ColdStart, ends_with_a_set_that_is_its_own_next_one) {
  StringOnTable table(2001);
  algebra::Factorisation factorisation(table.matrix);
  const auto cold = contact::solve_primal_dual_active_set(table.problem, {}, factorisation);
  const auto warm = contact::solve_primal_dual_active_set(table.problem, cold.activity, factorisation);
  ASSERT_EQ(warm.status, Status::solved);
  EXPECT_EQ(warm.iterations.size(), 1u);
  EXPECT_EQ(warm.activity, cold.activity);
}

}  // namespace
}  // namespace plastron::test

// Layouts and their exchange plans: which ranks communicate, the order of sums, and that a plan is made once.
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/layout.hpp>

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "algebra/allocations.hpp"
#include "algebra/chain.hpp"
#include "algebra/mpi_calls.hpp"

namespace plastron::test {
namespace {

constexpr GlobalIndex nodes = 12;

/// The stiffness of a chain of springs. A spring under the first node supports it.
Matrix springs(const std::shared_ptr<const Layout>& layout) {
  const auto elements = chain(nodes);
  Matrix A(layout, 1, connectivity(*layout, elements));
  for (const auto& element : elements)
    if (layout->owns(element.front())) A.add(local_nodes(*layout, element), std::vector<double>{2, -1, -1, 1});
  A.finish();
  return A;
}

/// Every rank sees the nodes next to its own, on both sides.
std::shared_ptr<const Layout> with_both_neighbours() {
  Distribution mine = pieces(nodes, MPI_COMM_WORLD);
  for (const GlobalIndex node : {mine.first - 1, mine.first + mine.owned})
    if (node >= 0 && node < nodes) mine.add_ghosts({node});
  return std::make_shared<const Layout>(std::move(mine));
}

TEST(Distribution, numbers_every_node_that_it_sees) {
  Distribution mine{.first = 10, .owned = 3, .global_size = 20};
  mine.add_ghosts({17, 2, 11, 17});
  EXPECT_EQ(mine.ghosts, (std::vector<GlobalIndex>{2, 17}));
  mine.add_ghosts({2, 5, 12});
  EXPECT_EQ(mine.ghosts, (std::vector<GlobalIndex>{2, 5, 17}));
  for (LocalIndex i = 0; i < mine.local_size(); ++i) EXPECT_EQ(mine.local(mine.global(i)), i);
  EXPECT_TRUE(mine.sees(10) && mine.sees(12) && mine.sees(5));
  EXPECT_FALSE(mine.sees(9) || mine.sees(13) || mine.sees(18));
  EXPECT_TRUE(mine.owns(12));
  EXPECT_FALSE(mine.owns(13));
}

TEST(Layout, has_those_ranks_for_neighbours_with_which_it_shares_ghosts) {
  const auto layout = layout_for(nodes, chain(nodes));
  std::vector<int> expected;
  for (const int other : {rank() - 1, rank() + 1})
    if (other >= 0 && other < ranks()) expected.push_back(other);
  const auto neighbours = layout->exchange().neighbours();
  EXPECT_EQ(std::vector<int>(neighbours.begin(), neighbours.end()), expected);
}

TEST(Layout, lets_ranks_without_neighbours_take_part) {
  Distribution mine = pieces(nodes, MPI_COMM_WORLD);
  if (rank() == 0 && ranks() > 1) mine.add_ghosts({mine.owned});
  const auto layout = std::make_shared<const Layout>(std::move(mine));
  EXPECT_EQ(layout->exchange().neighbours().size(), rank() < 2 && ranks() > 1 ? 1U : 0U);
  const Vector v = vector_of(layout, 2, [](GlobalIndex i) { return 1.0 + static_cast<double>(i); });
  EXPECT_TRUE(algebra::ghosts_are_current(v));
  Vector w(layout, 2);
  w.fill(1);
  w.accumulate_ghosts();
  EXPECT_EQ(algebra::sum_over_ranks(w.owned().empty() ? 0.0 : w.owned()[0], MPI_COMM_WORLD),
            ranks() > 1 ? ranks() + 1 : 1);
}

TEST(Layout, sums_the_values_of_ghosts_in_the_order_of_the_ranks) {
  Distribution mine = pieces(nodes, MPI_COMM_WORLD);
  if (rank() > 0) mine.add_ghosts({0});
  Vector v(std::make_shared<const Layout>(std::move(mine)), 1);
  constexpr double large = 1e17;  // large + 1 is large
  const double values[] = {large, -large, 1};
  (rank() == 0 ? v.owned()[0] : v.local().back()) = values[rank()];
  v.accumulate_ghosts();
  const double sums[] = {large, 0, 1};
  if (rank() == 0) {
    EXPECT_EQ(v.owned()[0], sums[ranks() - 1]);
  }
}

TEST(Layout, without_ghosts_has_nobody_to_talk_to) {
  const Calls calls;
  const auto layout = std::make_shared<const Layout>(pieces(nodes, MPI_COMM_WORLD));
  vector_of(layout, 1, [](GlobalIndex) { return 1.0; }).accumulate_ghosts();
  EXPECT_EQ(calls.graphs() + calls.all_to_all() + calls.neighbours(), 0);
}

TEST(Layout, makes_one_plan_for_all_vectors_and_matrices_on_it) {
  const Calls calls;
  {
    const auto layout = with_both_neighbours();
    const Vector v = vector_of(layout, 3, [](GlobalIndex i) { return static_cast<double>(i); });
    Vector w = v;
    w.accumulate_ghosts();
    const Matrix A = springs(layout), B = A.plus_multiple(2, springs(layout));
    EXPECT_EQ(B.layout(), layout);
    EXPECT_EQ(calls.graphs(), ranks() > 1 ? 1 : 0);
    EXPECT_EQ(calls.freed(), 0);
  }
  EXPECT_EQ(calls.freed(), calls.graphs());
}

TEST(Layout, of_a_matrix_has_further_ghosts_only_where_others_couple_what_a_rank_does_not_see) {
  const auto graphs_of = [](const Elements& elements) {
    const auto layout = layout_for(nodes, elements);
    const Calls calls;
    const Matrix A(layout, 1, connectivity(*layout, elements));
    return calls.graphs();
  };
  EXPECT_EQ(graphs_of(chain(nodes)), 0);
  Elements ring = chain(nodes);
  ring.push_back({nodes - 1, 0});  // of the last rank, which does not see its first node
  EXPECT_EQ(graphs_of(ring), ranks() > 1 ? 1 : 0);
}

TEST(Operators, are_applied_without_plans_and_talk_to_neighbours_alone) {
  const auto layout = with_both_neighbours();
  const Matrix A = springs(layout);
  Vector x = vector_of(layout, 1, [](GlobalIndex i) { return static_cast<double>(i % 3); }), y(layout, 1);
  const Calls calls;
  A.multiply(x, y);
  EXPECT_EQ(calls.neighbours(), ranks() > 1 ? 2 : 0);
  const Allocations allocations;
  A.multiply(x, y);
  EXPECT_EQ(allocations.count(), 0);
  const auto apply = [&](const Vector& from, Vector& to) { A.multiply(from, to); };
  const auto copy = [](const Vector& from, Vector& to) { to = from; };
  x.fill(0);
  const auto result = algebra::conjugate_gradients(apply, copy, y, {}, {}, x,
                                                   {.tolerance = 1e-10, .max_steps = 2 * nodes, .patience = nodes});
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(calls.graphs() + calls.all_to_all(), 0);
}

TEST(Matrix, ships_rows_of_ghosts_in_one_exchange) {
  const auto layout = with_both_neighbours();
  Matrix A = springs(layout);
  const Calls calls;
  A.set_zero();
  A.finish();
  EXPECT_EQ(calls.neighbours(), ranks() > 1 ? 1 : 0);
  EXPECT_EQ(calls.graphs() + calls.all_to_all(), 0);
}

}  // namespace
}  // namespace plastron::test

#include <plastron/algebra/gathered.hpp>
#include <plastron/algebra/vector.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "algebra/chain.hpp"

namespace plastron::test {
namespace {

constexpr GlobalIndex nodes = 11;
constexpr int block = 3;

double number_of(GlobalIndex i) { return 1.0 + static_cast<double>(i); }

// Every rank sees the neighbours of its nodes, and node 0.
std::shared_ptr<const Layout> example_layout() {
  Elements elements = chain(nodes);
  for (GlobalIndex i = 1; i < nodes; ++i) elements.push_back({i, 0});
  return layout_for(nodes, elements);
}

TEST(Vector, ghosts_take_the_values_of_their_owners) {
  const auto layout = example_layout();
  const Vector v = vector_of(layout, block, number_of);
  for (LocalIndex i = 0; i < layout->local_size(); ++i)
    for (int c = 0; c < block; ++c)
      EXPECT_EQ(v.local()[static_cast<std::size_t>(i * block + c)], number_of(layout->global(i) * block + c));
}

TEST(Vector, accumulated_ghosts_end_at_their_owners_and_are_zero_afterwards) {
  const auto layout = example_layout();
  Vector v(layout, block);
  v.fill(1.0);
  v.accumulate_ghosts();
  const double total = algebra::sum_over_ranks(static_cast<double>(layout->local_size()), MPI_COMM_WORLD) * block;
  double sum = 0;
  for (const double value : v.local()) sum += value;
  EXPECT_EQ(algebra::sum_over_ranks(sum, MPI_COMM_WORLD), total);
  for (std::size_t i = v.owned().size(); i < v.local().size(); ++i) EXPECT_EQ(v.local()[i], 0.0);
}

TEST(Vector, knows_whether_its_ghosts_are_those_of_their_owners) {
  const auto layout = example_layout();
  Vector v = vector_of(layout, block, number_of);
  EXPECT_TRUE(algebra::ghosts_are_current(v));
  v.owned().front() = 0;  // the rank before sees this node
  EXPECT_EQ(algebra::ghosts_are_current(v), ranks() == 1);
  v.update_ghosts();
  EXPECT_TRUE(algebra::ghosts_are_current(v));
  for (double& value : v.local()) value = std::nan("");
  EXPECT_TRUE(algebra::ghosts_are_current(v));
}

TEST(Gathered, items_come_by_rank_to_every_rank_or_to_the_first_one) {
  struct Item {
    std::int64_t number;
    std::array<char, 3> text;
    bool operator==(const Item&) const = default;
  };
  const auto items_of = [](int r) {
    return std::vector<Item>(static_cast<std::size_t>(2 * r % 3), Item{r, {'a', 'b', static_cast<char>('0' + r)}});
  };
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<Item> all;
  for (int r = 0; r < ranks; ++r) std::ranges::copy(items_of(r), std::back_inserter(all));
  EXPECT_EQ(algebra::gathered(items_of(rank()), MPI_COMM_WORLD), all);
  if (rank() > 0) all.clear();
  EXPECT_EQ(algebra::gathered(items_of(rank()), MPI_COMM_WORLD, algebra::Receivers::first_rank), all);
}

TEST(Gathered, more_items_than_mpi_can_count_is_refused_on_all_ranks) {
  const std::vector<double> one(1);
  const std::size_t too_many = std::size_t{1} << 31;  // refused before they are read
  const std::span<const double> mine(one.data(), rank() == 0 ? too_many : 0);
  EXPECT_THROW(algebra::gathered(mine, MPI_COMM_WORLD), std::length_error);
  EXPECT_NO_THROW(algebra::check_gathered(static_cast<std::int64_t>(too_many) - 1));
}

TEST(Vector, copies_are_independent) {
  const auto layout = example_layout();
  const Vector a = vector_of(layout, block, number_of);
  Vector b = a;
  b.fill(0.0);
  EXPECT_EQ(gather(a)[4], number_of(4));
  b = a;
  EXPECT_EQ(gather(b), gather(a));
}

TEST(Vector, an_empty_one_can_be_copied_read_and_assigned_to) {
  const Vector empty;
  Vector v(empty);
  EXPECT_TRUE(v.owned().empty());
  EXPECT_EQ(v.layout(), nullptr);
  v.update_ghosts();
  v = vector_of(example_layout(), block, number_of);
  const Vector taken = std::move(v);
  EXPECT_EQ(gather(taken)[2], number_of(2));
  v = Vector();
  EXPECT_EQ(v.block(), 0);
}

TEST(Vector, sums_and_norms_run_over_the_owned_values_of_all_ranks) {
  const auto layout = example_layout();
  const Vector a = vector_of(layout, block, number_of);
  constexpr double n = nodes * block;
  EXPECT_DOUBLE_EQ(dot(a, a), n * (n + 1) * (2 * n + 1) / 6);
  EXPECT_DOUBLE_EQ(norm(a), std::sqrt(dot(a, a)));
  EXPECT_EQ(max_abs(a), n);
  Vector b = a;
  axpy(-2.0, a, b);
  EXPECT_EQ(gather(b)[7], -number_of(7));
}

TEST(Vector, reductions_agree_on_all_ranks) {
  const double mine = 1.0 + rank();
  EXPECT_EQ(algebra::sum_over_ranks(mine, MPI_COMM_WORLD), 0.5 * ranks() * (ranks() + 1));
  EXPECT_EQ(algebra::min_over_ranks(mine, MPI_COMM_WORLD), 1.0);
  EXPECT_EQ(algebra::max_over_ranks(mine, MPI_COMM_WORLD), ranks());
  EXPECT_EQ(algebra::sum_over_ranks(std::int64_t{1} << 40, MPI_COMM_WORLD), ranks() * (std::int64_t{1} << 40));
}

}  // namespace
}  // namespace plastron::test

// Items of all ranks in one list.
#pragma once
#include <plastron/algebra/vector.hpp>

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <ranges>
#include <span>
#include <type_traits>
#include <vector>

namespace plastron::algebra {

enum class Receivers { every_rank, first_rank };

namespace gathering {

/// Numbers of items of all ranks, and where the items of each rank begin in the list of all.
struct Plan {
  std::vector<int> counts, starts;
  std::size_t total = 0;
};

/// Throws the errors of check_gathered() on all ranks (collective).
Plan plan(std::size_t mine, MPI_Comm comm);
/// Copies items of `size` bytes; `all` has room for all items on a rank that receives them (collective).
void gather(const void* mine, std::size_t size, const Plan& plan, void* all, Receivers receivers, MPI_Comm comm);

}  // namespace gathering

/// Throws std::length_error for more items than MPI counts in one call, 2^31 - 1.
void check_gathered(std::int64_t items);

/// Returns the items of all ranks, ordered by rank, equal on every rank that receives them, empty on the others
/// (collective). For data that are small on every rank, or that must be complete somewhere. An item is a number, an
/// Eigen vector of fixed size, or a struct of them; Eigen 3.4 copies its vectors by constructors, so the compiler can
/// only see that items own nothing. Throws the errors of check_gathered() on all ranks.
template <std::ranges::contiguous_range Items>
auto gathered(const Items& mine, MPI_Comm comm, Receivers receivers = Receivers::every_rank) {
  using Item = std::ranges::range_value_t<Items>;
  static_assert(std::is_trivially_destructible_v<Item> && !std::is_pointer_v<Item>,
                "an item with pointers has no meaning on another rank");
  const gathering::Plan plan = gathering::plan(std::ranges::size(mine), comm);
  std::vector<Item> all(receivers == Receivers::every_rank || rank_in(comm) == 0 ? plan.total : 0);
  gathering::gather(std::ranges::data(mine), sizeof(Item), plan, all.data(), receivers, comm);
  return all;
}

/// Returns sums over ranks, entry by entry, equal on every rank. All ranks give the same number of values (collective).
std::vector<double> sums_over_ranks(std::span<const double> mine, MPI_Comm comm);

}  // namespace plastron::algebra

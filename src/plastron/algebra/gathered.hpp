// Items of all ranks in one list.
#pragma once
#include <mpi.h>

#include <cstddef>
#include <ranges>
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
bool receives(Receivers receivers, MPI_Comm comm);

}  // namespace gathering

/// Returns the items of all ranks, ordered by rank, equal on every rank that receives them, empty on the others
/// (collective). For data that are small on every rank, or that must be complete somewhere. Throws the errors of
/// check_gathered() on all ranks.
template <std::ranges::contiguous_range Items>
auto gathered(const Items& mine, MPI_Comm comm, Receivers receivers = Receivers::every_rank) {
  using Item = std::ranges::range_value_t<Items>;
  static_assert(std::is_trivially_copyable_v<Item>, "an item with pointers has no meaning on another rank");
  const gathering::Plan plan = gathering::plan(std::ranges::size(mine), comm);
  std::vector<Item> all(gathering::receives(receivers, comm) ? plan.total : 0);
  gathering::gather(std::ranges::data(mine), sizeof(Item), plan, all.data(), receivers, comm);
  return all;
}

}  // namespace plastron::algebra

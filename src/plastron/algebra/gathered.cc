#include <plastron/algebra/gathered.hpp>
#include <plastron/algebra/layout.hpp>

#include <fmt/core.h>

#include <limits>
#include <numeric>
#include <stdexcept>

namespace plastron::algebra {

namespace gathering {

Plan plan(std::size_t mine, MPI_Comm comm) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const std::int64_t total = sum_over_ranks(static_cast<std::int64_t>(mine), comm);
  check_gathered(total);
  const auto count = static_cast<int>(mine);
  Plan plan{.counts = std::vector<int>(static_cast<std::size_t>(ranks)),
            .starts = std::vector<int>(static_cast<std::size_t>(ranks)),
            .total = static_cast<std::size_t>(total)};
  MPI_Allgather(&count, 1, MPI_INT, plan.counts.data(), 1, MPI_INT, comm);
  std::exclusive_scan(plan.counts.begin(), plan.counts.end(), plan.starts.begin(), 0);
  return plan;
}

void gather(const void* mine, std::size_t size, const Plan& plan, void* all, Receivers receivers, MPI_Comm comm) {
  const ItemType item(static_cast<int>(size), MPI_BYTE);
  const int count = plan.counts[static_cast<std::size_t>(rank_in(comm))];
  if (receivers == Receivers::every_rank)
    MPI_Allgatherv(mine, count, item.get(), all, plan.counts.data(), plan.starts.data(), item.get(), comm);
  else
    MPI_Gatherv(mine, count, item.get(), all, plan.counts.data(), plan.starts.data(), item.get(), 0, comm);
}

}  // namespace gathering

void check_gathered(std::int64_t items) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  if (items > most)
    throw std::length_error(
        fmt::format("{} values of all processes would come together on each one, more than the {} that MPI can count: "
                    "take a coarser mesh",
                    items, most));
}

std::vector<double> sums_over_ranks(std::span<const double> mine, MPI_Comm comm) {
  const std::vector<double> all = gathered(mine, comm);
  std::vector<double> sums(mine.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i) sums[i % sums.size()] += all[i];
  return sums;
}

}  // namespace plastron::algebra

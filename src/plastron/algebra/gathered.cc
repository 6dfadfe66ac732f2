#include <plastron/algebra/gathered.hpp>
#include <plastron/algebra/layout.hpp>
#include <plastron/algebra/vector.hpp>

#include <numeric>

namespace plastron::algebra::gathering {

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
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const ItemType item(static_cast<int>(size), MPI_BYTE);
  const int count = plan.counts[static_cast<std::size_t>(rank)];
  if (receivers == Receivers::every_rank)
    MPI_Allgatherv(mine, count, item.get(), all, plan.counts.data(), plan.starts.data(), item.get(), comm);
  else
    MPI_Gatherv(mine, count, item.get(), all, plan.counts.data(), plan.starts.data(), item.get(), 0, comm);
}

bool receives(Receivers receivers, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return receivers == Receivers::every_rank || rank == 0;
}

}  // namespace plastron::algebra::gathering

#include "block_exchange.hpp"

#include <numeric>

namespace plastron::algebra {
namespace {

// `per_block` items of each block.
template <class Value>
void send(const std::vector<Value>& out, const std::vector<int>& out_blocks, std::vector<Value>& in,
          const std::vector<int>& in_blocks, int per_block, MPI_Datatype type, MPI_Comm comm) {
  MPI_Datatype item = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(per_block, type, &item);
  MPI_Type_commit(&item);
  std::vector<int> out_start(out_blocks.size());
  std::vector<int> in_start(in_blocks.size());
  std::exclusive_scan(out_blocks.begin(), out_blocks.end(), out_start.begin(), 0);
  std::exclusive_scan(in_blocks.begin(), in_blocks.end(), in_start.begin(), 0);
  in.resize(static_cast<std::size_t>(in_start.back() + in_blocks.back()) * static_cast<std::size_t>(per_block));
  MPI_Alltoallv(out.data(), out_blocks.data(), out_start.data(), item, in.data(), in_blocks.data(), in_start.data(),
                item, comm);
  MPI_Type_free(&item);
}

}  // namespace

TravellingBlocks exchange_blocks(const TravellingBlocks& out, int block_area, MPI_Comm comm) {
  TravellingBlocks in;
  in.blocks_of_rank.resize(out.blocks_of_rank.size());
  MPI_Alltoall(out.blocks_of_rank.data(), 1, MPI_INT, in.blocks_of_rank.data(), 1, MPI_INT, comm);
  send(out.places, out.blocks_of_rank, in.places, in.blocks_of_rank, 2, MPI_INT64_T, comm);
  if (block_area > 0) send(out.values, out.blocks_of_rank, in.values, in.blocks_of_rank, block_area, MPI_DOUBLE, comm);
  return in;
}

}  // namespace plastron::algebra

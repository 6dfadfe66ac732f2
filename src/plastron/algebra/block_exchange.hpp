// Blocks of a matrix on their way from the ranks that computed them to the rank that owns their row.
#pragma once
#include <plastron/algebra/layout.hpp>

#include <vector>

namespace plastron::algebra {

struct TravellingBlocks {
  std::vector<GlobalIndex> places{};  ///< global row and column of each block, rank after rank
  std::vector<double> values{};       ///< empty if only the pattern travels
  std::vector<int> blocks_of_rank{};  ///< where they go to, or come from
};

/// What the others have sent here (collective). Blocks hold `block_area` values, or none.
TravellingBlocks exchange_blocks(const TravellingBlocks& out, int block_area, MPI_Comm comm);

}  // namespace plastron::algebra

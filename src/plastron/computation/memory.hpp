// How much memory the computation took, and how much it may take.
#pragma once
#include <mpi.h>

#include <string>

namespace plastron::computation {

/// Peak resident memory of all ranks together [bytes] (collective).
double peak_memory(MPI_Comm comm);

/// Peak resident memory of the ranks on one machine over the memory that they may take there: what is free or theirs, and no more than the
/// limit of their control group. The largest such part of all machines (collective).
struct MemoryUse {
  double peak = 0;   ///< [bytes]
  double limit = 0;  ///< [bytes]
};
MemoryUse memory_use(MPI_Comm comm);

/// Why a mesh with so many times the unknowns of the largest one so far does not fit into memory, in words; empty if it does.
std::string memory_obstacle(const MemoryUse& use, double growth);

}  // namespace plastron::computation

// Memory use of the computation, and its limit.
#pragma once
#include <mpi.h>

#include <string>

namespace plastron::computation {

/// Peak resident memory of all ranks together [bytes] (collective).
double peak_memory(MPI_Comm comm);

/// Peak resident memory of the ranks on one machine, and the memory that they may use there. The limit is the free
/// memory plus their own, at most the limit of their control group. Data of the machine with the largest ratio
/// (collective).
struct MemoryUse {
  double peak = 0;   ///< [bytes]
  double limit = 0;  ///< [bytes]
};
MemoryUse memory_use(MPI_Comm comm);

/// Returns the reason why a mesh with `growth` times the unknowns of the largest one so far does not fit into memory;
/// empty if it fits.
std::string memory_obstacle(const MemoryUse& use, double growth);

}  // namespace plastron::computation

#include <plastron/computation/memory.hpp>

#include <plastron/algebra/vector.hpp>

#include <sys/resource.h>

namespace plastron::computation {

double peak_memory(MPI_Comm comm) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return algebra::sum_over_ranks(1024.0 * static_cast<double>(usage.ru_maxrss), comm);  // Linux counts kilobytes
}

}  // namespace plastron::computation

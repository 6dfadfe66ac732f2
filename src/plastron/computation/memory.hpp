// How much memory the computation took.
#pragma once
#include <mpi.h>

namespace plastron::computation {

/// Peak resident memory of all ranks together [bytes] (collective).
double peak_memory(MPI_Comm comm);

}  // namespace plastron::computation

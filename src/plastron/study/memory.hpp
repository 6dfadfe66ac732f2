// How much memory the computation took.
#pragma once
#include <mpi.h>

namespace plastron::study {

/// Peak resident memory of all ranks together [bytes] (collective).
double peak_memory(MPI_Comm comm);

}  // namespace plastron::study

// Starts and ends MPI, PETSc with SLEPc, and the BLAS threads. One per program, alive as long as any vector or matrix.
#pragma once
#include <mpi.h>

namespace plastron::algebra {

class Session {
 public:
  /// PETSc reads no options from the command line, the environment or files.
  /// `threads` of the BLAS in each process; 0: one in a job of several processes, else as many as there are cores.
  Session(int& argc, char**& argv, int threads = 0);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

}  // namespace plastron::algebra

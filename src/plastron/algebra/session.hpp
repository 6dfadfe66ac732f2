// Starts and ends MPI, PETSc with SLEPc, and restricts threads (threads.hpp). One per program, alive as long as any vector or matrix.
#pragma once
#include <mpi.h>

namespace plastron::algebra {

class Session {
 public:
  /// PETSc reads no options from the command line, the environment or files. `threads`: at most that many in each rank, 0: by default.
  Session(int& argc, char**& argv, int threads = 0);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

}  // namespace plastron::algebra

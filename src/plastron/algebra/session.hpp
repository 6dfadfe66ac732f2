// Starts and ends MPI, PETSc with SLEPc, and restricts threads (threads.hpp).
#pragma once
#include <mpi.h>

namespace plastron::algebra {

/// One per program, alive as long as any vector or matrix. What runs already it leaves running, and does not end: MPI and PETSc belong to
/// whoever started them. A program that starts MPI itself needs no Session; PETSc is then started where it is needed first, ends with
/// MPI_Finalize, and threads are the program's own affair.
class Session {
 public:
  /// PETSc reads no options from the command line, the environment or files. `threads`: at most that many in each rank, 0: by default.
  /// (collective)
  Session(int& argc, char**& argv, int threads = 0);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  bool owns_mpi_;
  bool owns_slepc_;  ///< and PETSc, if that did not run before
};

}  // namespace plastron::algebra

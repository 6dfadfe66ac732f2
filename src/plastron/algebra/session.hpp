// Starts and ends MPI, PETSc with SLEPc, and restricts threads (threads.hpp).
#pragma once
#include <cstdlib>
#include <initializer_list>

namespace plastron::algebra {

/// One object for each program; it exists as long as any vector or matrix. It leaves software that already runs
/// unchanged and does not end it: MPI and PETSc belong to the code that started them. A program that starts MPI itself
/// needs no Session. PETSc is then started where it is first needed and ends with MPI_Finalize, and the program itself
/// sets its threads.
class Session {
 public:
  /// Starts the session. PETSc reads no options from the command line, the environment or files. `threads`: largest
  /// number in each rank; 0: by default. (collective)
  Session(int& argc, char**& argv, int threads = 0);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  bool owns_mpi_;
  bool owns_slepc_;  ///< owns SLEPc, and also PETSc if that did not run before
};

/// Returns the rank that a launcher of parallel jobs (mpiexec, srun) gave this process, as text; null if there was no
/// launcher. It reads only the environment, before MPI starts.
inline const char* rank_of_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "MV2_COMM_WORLD_RANK", "SLURM_PROCID"})
    if (const char* value = std::getenv(name)) return value;
  return nullptr;
}

}  // namespace plastron::algebra

// Detects whether a launcher of parallel jobs (mpiexec, srun) started this process. It reads only the environment,
// before MPI starts.
#pragma once
#include <cstdlib>
#include <initializer_list>

namespace plastron::algebra {

/// Returns the rank that the launcher gave this process, as text; null if there was no launcher.
inline const char* rank_of_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "MV2_COMM_WORLD_RANK", "SLURM_PROCID"})
    if (const char* value = std::getenv(name)) return value;
  return nullptr;
}

}  // namespace plastron::algebra

// Converts PETSc's error codes to exceptions. Included by .cc files only: no header of ours shows PETSc.
#pragma once
#include <petscsys.h>

#include <new>
#include <stdexcept>
#include <string>

namespace plastron::algebra {

/// Whether memory was insufficient; CHOLMOD reports this with its status -2.
inline bool is_out_of_memory(PetscErrorCode code, const std::string& message) {
  return code == PETSC_ERR_MEM || message.find("CHOLMOD factorization failed with status -2") != std::string::npos;
}

/// Throws std::runtime_error with PETSc's message, or std::bad_alloc where memory was insufficient. `doing` names the
/// requested operation.
inline void petsc_check(PetscErrorCode code, const char* doing) {
  if (code == 0) return;
  const char* general = nullptr;
  char* specific = nullptr;
  PetscErrorMessage(code, &general, &specific);
  std::string message = std::string("PETSc failed while ") + doing + ": " + (general ? general : "unknown error");
  if (specific && *specific) message += std::string(" (") + specific + ")";
  if (is_out_of_memory(code, message)) throw std::bad_alloc();
  throw std::runtime_error(message);
}

}  // namespace plastron::algebra

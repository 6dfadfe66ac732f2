// Turns PETSc's error codes into exceptions. Included by .cc files only: no header of ours shows PETSc.
#pragma once
#include <petscsys.h>

#include <stdexcept>
#include <string>

namespace plastron::algebra {

/// Throws std::runtime_error with PETSc's own words. `doing` names what we asked for.
inline void petsc_check(PetscErrorCode code, const char* doing) {
  if (code == 0) return;
  const char* general = nullptr;
  char* specific = nullptr;
  PetscErrorMessage(code, &general, &specific);
  std::string message = std::string("PETSc failed while ") + doing + ": " + (general ? general : "unknown error");
  if (specific && *specific) message += std::string(" (") + specific + ")";
  throw std::runtime_error(message);
}

}  // namespace plastron::algebra

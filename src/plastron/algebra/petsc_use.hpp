// PETSc and SLEPc as guests: started where nobody has, silent while we call them, and otherwise left as they are found. Included by .cc
// files only.
#pragma once
#include <petscsys.h>

namespace plastron::algebra {

/// Starts SLEPc, and PETSc if that is not running either, on `world`. False if SLEPc ran already. (collective on `world`)
bool start_slepc(MPI_Comm world);

/// While this lives PETSc prints nothing: its errors come back as codes (petsc_check.hpp). Starts PETSc if nobody has, each process for
/// itself, until MPI_Finalize.
class PetscUse {
 public:
  PetscUse();
  ~PetscUse();
  PetscUse(const PetscUse&) = delete;
  PetscUse& operator=(const PetscUse&) = delete;

 private:
  PetscErrorCode (*print_)(const char[], ...);
};

}  // namespace plastron::algebra

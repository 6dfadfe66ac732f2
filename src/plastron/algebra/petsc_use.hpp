// Use of PETSc and SLEPc: started if not yet running, without output during our calls, and otherwise unchanged.
// Included by .cc files only.
#pragma once
#include <petscsys.h>

namespace plastron::algebra {

/// Starts SLEPc on `world`, and PETSc if it does not run either. Returns false if SLEPc ran already. (collective on
/// `world`)
bool start_slepc(MPI_Comm world);

/// While this object exists, PETSc prints nothing: its errors are returned as codes (petsc_check.hpp). Starts PETSc if
/// it does not run, in each process separately, until MPI_Finalize.
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

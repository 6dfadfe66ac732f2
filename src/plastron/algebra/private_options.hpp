// A PETSc options database without the options of program or user. Included by .cc files only.
#pragma once
#include <petscsys.h>

#include "petsc_check.hpp"

namespace plastron::algebra {

/// A private database of PETSc options during a call. Options that the program or its user has set for other
/// solvers do not affect ours.
class PrivateOptions {
 public:
  PrivateOptions() {
    petsc_check(PetscOptionsCreate(&options_), "creating options");
    petsc_check(PetscOptionsPush(options_), "using private options");
  }
  ~PrivateOptions() {
    PetscOptionsPop();
    PetscOptionsDestroy(&options_);
  }
  PrivateOptions(const PrivateOptions&) = delete;
  PrivateOptions& operator=(const PrivateOptions&) = delete;
  void add(const char* name, const char* value) {
    petsc_check(PetscOptionsSetValue(options_, name, value), "setting an option");
  }

 private:
  PetscOptions options_ = nullptr;
};

}  // namespace plastron::algebra

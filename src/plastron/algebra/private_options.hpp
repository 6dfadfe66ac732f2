// PETSc's options database without anybody's options. Included by .cc files only.
#pragma once
#include <petscsys.h>

#include "petsc_check.hpp"

namespace plastron::algebra {

/// A database of PETSc options for the time of a call, seen by nobody else: what the program or its user has set for other
/// solvers does not reach ours.
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

// Our arrays as PETSc sees them. Included by .cc files only.
#pragma once
#include <plastron/algebra/layout.hpp>

#include <petscvec.h>

#include "petsc_check.hpp"

namespace plastron::algebra {

/// An owned array as a PETSc vector for the time of a call.
class BorrowedVec {
 public:
  BorrowedVec(const Layout& layout, int block, const double* values) {
    petsc_check(VecCreateMPIWithArray(layout.comm, 1, layout.owned * block, PETSC_DETERMINE, values, &vec_),
                "wrapping a vector");
  }
  ~BorrowedVec() { VecDestroy(&vec_); }
  BorrowedVec(const BorrowedVec&) = delete;
  BorrowedVec& operator=(const BorrowedVec&) = delete;
  Vec vec() const { return vec_; }

 private:
  Vec vec_ = nullptr;
};

}  // namespace plastron::algebra

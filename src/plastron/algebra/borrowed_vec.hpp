// Our arrays as PETSc sees them. Included by .cc files only.
#pragma once
#include <plastron/algebra/layout.hpp>

#include <petscvec.h>

#include "petsc_check.hpp"

namespace plastron::algebra {

/// A PETSc vector without values of its own: it has our owned ones while they are lent to it.
class BorrowedVec {
 public:
  /// (collective)
  BorrowedVec(const Layout& layout, int block) {
    petsc_check(VecCreateMPIWithArray(layout.comm, 1, layout.owned * block, PETSC_DETERMINE, nullptr, &vec_),
                "wrapping a vector");
  }
  ~BorrowedVec() { VecDestroy(&vec_); }
  BorrowedVec(const BorrowedVec&) = delete;
  BorrowedVec& operator=(const BorrowedVec&) = delete;
  Vec vec() const { return vec_; }

  /// `values` as those of `vec` for the time of a call.
  class Loan {
   public:
    Loan(const BorrowedVec& vec, const double* values) : vec_(vec.vec_) {
      petsc_check(VecPlaceArray(vec_, values), "wrapping a vector");
    }
    ~Loan() { VecResetArray(vec_); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

   private:
    Vec vec_;
  };

 private:
  Vec vec_ = nullptr;
};

}  // namespace plastron::algebra

// PETSc vectors on our arrays. Included by .cc files only.
#pragma once
#include <plastron/algebra/layout.hpp>

#include <petscvec.h>

#include "petsc_check.hpp"

namespace plastron::algebra {

/// A PETSc vector without values of its own. It uses our owned values while they are lent to it.
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

  /// Makes `values` the values of `vec` during a call.
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

// Cholesky factor of a matrix of several ranks with some unknowns pinned, by MUMPS. Includes PETSc: for .cc files only.
#pragma once
#include <plastron/algebra/factorisation.hpp>

#include <petscmat.h>

#include <vector>

#include "borrowed_vec.hpp"
#include "pinned_matrix.hpp"

namespace plastron::algebra {

class MumpsFactor {
 public:
  /// Analyses the pattern (collective).
  explicit MumpsFactor(const Matrix::Storage& A);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// Factorises like SupernodalFactor::factorise (collective).
  bool factorise(std::vector<double> pinned_diagonal, double shift);
  /// Solves for owned values (collective).
  void solve(const Vector& b, Vector& x) const;
  const FactorisationCost& cost() const { return cost_; }

 private:
  void analyse();

  const Matrix::Storage& A_;
  PinnedMatrix copy_;
  PetscInt extra_memory_ = 50;
  Mat factor_ = nullptr;
  MatFactorInfo info_{};
  BorrowedVec right_, solution_;
  FactorisationCost cost_{};
};

}  // namespace plastron::algebra

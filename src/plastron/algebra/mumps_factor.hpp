// Cholesky factor of a matrix of several ranks with some unknowns fixed, by MUMPS. Includes PETSc: for .cc files only.
#pragma once
#include <plastron/algebra/factorisation_cost.hpp>

#include <petscmat.h>

#include <span>
#include <vector>

#include "matrix_storage.hpp"
#include "petsc_use.hpp"

namespace plastron::algebra {

/// Returns for each unknown of A's nodes here, including ghosts, the diagonal entry of its row if it is fixed: A's own
/// where it is positive, A's largest elsewhere. The value is 0 where not fixed. Throws std::invalid_argument for a
/// wrong number of marks. (collective)
std::vector<double> fixed_diagonal(const MatrixStorage& A, std::span<const char> fixed);

/// The PETSc matrix that several ranks factorise: the upper half of a Matrix in blocked rows. A diagonal matrix
/// replaces the rows and columns of fixed unknowns. The pattern is the same for every set of fixed unknowns.
class PetscMatrix {
 public:
  /// Sets the pattern (collective).
  explicit PetscMatrix(const MatrixStorage& A);
  ~PetscMatrix();
  PetscMatrix(const PetscMatrix&) = delete;
  PetscMatrix& operator=(const PetscMatrix&) = delete;

  /// Sets the values of A + shift diag(A); `fixed_diagonal` is from the function above (collective).
  void fill(const MatrixStorage& A, std::vector<double> fixed_diagonal, double shift);
  Mat mat() const { return mat_; }

 private:
  void create(const MatrixStorage& A);
  void fill_rows(const MatrixStorage& A);
  void replace_fixed(std::size_t row, std::size_t column, std::size_t block, double* values, std::size_t stride) const;

  Mat mat_ = nullptr;
  double diagonal_factor_ = 1;            ///< 1 + shift
  std::vector<double> fixed_diagonal_{};  ///< for the nodes of `wide`: the diagonal where fixed, 0 where not
};

class MumpsFactor {
 public:
  /// Analyses the pattern (collective).
  explicit MumpsFactor(const MatrixStorage& A);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// Factorises like SupernodalFactor::factorise (collective).
  bool factorise(std::vector<double> fixed_diagonal, double shift);
  /// Solves for owned values (collective).
  void solve(const Vector& b, Vector& x) const;
  const FactorisationCost& cost() const { return cost_; }

 private:
  void analyse();

  const MatrixStorage& A_;
  PetscMatrix copy_;
  PetscInt extra_memory_ = 50;
  Mat factor_ = nullptr;
  MatFactorInfo info_{};
  BorrowedVec right_, solution_;
  FactorisationCost cost_{};
};

}  // namespace plastron::algebra

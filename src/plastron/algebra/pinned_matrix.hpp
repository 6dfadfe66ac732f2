// The PETSc matrix that is factorised: the upper half of a Matrix with the rows and columns of pinned unknowns replaced
// by those of a diagonal matrix. Same pattern for every set of pinned unknowns. Includes PETSc: for .cc files only.
#pragma once
#include <petscmat.h>

#include <span>
#include <vector>

#include "matrix_storage.hpp"

namespace plastron::algebra {

class PinnedMatrix {
 public:
  /// Takes the pattern (collective). One rank: scalar rows in arrays of ours, which CHOLMOD reads in place; several:
  /// PETSc's blocked rows.
  explicit PinnedMatrix(const Matrix::Storage& A);
  ~PinnedMatrix();
  PinnedMatrix(const PinnedMatrix&) = delete;
  PinnedMatrix& operator=(const PinnedMatrix&) = delete;

  /// Takes the values of A + shift diag(A) (collective).
  void fill(const Matrix::Storage& A, std::span<const char> pinned, double shift);
  Mat mat() const { return mat_; }

 private:
  void create_on_one_rank(const Matrix::Storage& A);
  void create_on_several_ranks(const Matrix::Storage& A);
  void fill_arrays(const Matrix::Storage& A);
  void fill_blocked_rows(const Matrix::Storage& A);
  void mark_pinned(const Matrix::Storage& A, std::span<const char> pinned);
  void replace_pinned(std::size_t row, std::size_t column, std::size_t block, double* values, std::size_t stride) const;

  Mat mat_ = nullptr;
  double diagonal_factor_ = 1;         ///< 1 + shift
  bool alone_ = true;                  ///< one rank
  std::vector<PetscInt> row_start_{};  ///< one rank only: the upper half by scalar rows
  std::vector<PetscInt> column_{};
  std::vector<double> values_{};
  std::vector<double> pinned_diagonal_{};  ///< of the nodes of `wide`: the diagonal where pinned, 0 where not
};

}  // namespace plastron::algebra

// The PETSc matrix that several ranks factorise: the upper half of a Matrix with the rows and columns of pinned unknowns replaced
// by those of a diagonal matrix, in blocked rows. Same pattern for every set of pinned unknowns. Includes PETSc: for .cc files only.
#pragma once
#include <petscmat.h>

#include <span>
#include <vector>

#include "matrix_storage.hpp"

namespace plastron::algebra {

/// For each unknown of A's nodes here, ghosts too: the diagonal entry that stands in for the row of a pinned unknown, A's own where that is
/// positive and A's largest elsewhere; 0 where not pinned. Throws std::invalid_argument for marks of a wrong number. (collective)
std::vector<double> pinned_diagonal(const Matrix::Storage& A, std::span<const char> pinned);

class PinnedMatrix {
 public:
  /// Takes the pattern (collective).
  explicit PinnedMatrix(const Matrix::Storage& A);
  ~PinnedMatrix();
  PinnedMatrix(const PinnedMatrix&) = delete;
  PinnedMatrix& operator=(const PinnedMatrix&) = delete;

  /// Takes the values of A + shift diag(A), `pinned_diagonal` from the function above (collective).
  void fill(const Matrix::Storage& A, std::vector<double> pinned_diagonal, double shift);
  Mat mat() const { return mat_; }

 private:
  void create(const Matrix::Storage& A);
  void fill_rows(const Matrix::Storage& A);
  void replace_pinned(std::size_t row, std::size_t column, std::size_t block, double* values, std::size_t stride) const;

  Mat mat_ = nullptr;
  double diagonal_factor_ = 1;             ///< 1 + shift
  std::vector<double> pinned_diagonal_{};  ///< of the nodes of `wide`: the diagonal where pinned, 0 where not
};

}  // namespace plastron::algebra

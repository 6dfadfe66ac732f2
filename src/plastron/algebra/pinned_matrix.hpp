// The PETSc matrix that several ranks factorise: the upper half of a Matrix in blocked rows. A diagonal matrix replaces
// the rows and columns of pinned unknowns. The pattern is the same for every set of pinned unknowns. Includes PETSc:
// for .cc files only.
#pragma once
#include <petscmat.h>

#include <span>
#include <vector>

#include "matrix_storage.hpp"

namespace plastron::algebra {

/// Returns for each unknown of A's nodes here, including ghosts, the diagonal entry of its row if it is pinned: A's own
/// where it is positive, A's largest elsewhere. The value is 0 where not pinned. Throws std::invalid_argument for a
/// wrong number of marks. (collective)
std::vector<double> pinned_diagonal(const Matrix::Storage& A, std::span<const char> pinned);

class PinnedMatrix {
 public:
  /// Sets the pattern (collective).
  explicit PinnedMatrix(const Matrix::Storage& A);
  ~PinnedMatrix();
  PinnedMatrix(const PinnedMatrix&) = delete;
  PinnedMatrix& operator=(const PinnedMatrix&) = delete;

  /// Sets the values of A + shift diag(A); `pinned_diagonal` is from the function above (collective).
  void fill(const Matrix::Storage& A, std::vector<double> pinned_diagonal, double shift);
  Mat mat() const { return mat_; }

 private:
  void create(const Matrix::Storage& A);
  void fill_rows(const Matrix::Storage& A);
  void replace_pinned(std::size_t row, std::size_t column, std::size_t block, double* values, std::size_t stride) const;

  Mat mat_ = nullptr;
  double diagonal_factor_ = 1;             ///< 1 + shift
  std::vector<double> pinned_diagonal_{};  ///< for the nodes of `wide`: the diagonal where pinned, 0 where not
};

}  // namespace plastron::algebra

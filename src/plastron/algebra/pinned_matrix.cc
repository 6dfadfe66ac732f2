#include "pinned_matrix.hpp"

#include <plastron/algebra/agreement.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "petsc_check.hpp"

namespace plastron::algebra {
namespace {

void declare_positive_definite(Mat mat) {
  petsc_check(MatSetOption(mat, MAT_SYMMETRIC, PETSC_TRUE), "declaring a matrix symmetric");
  petsc_check(MatSetOption(mat, MAT_SPD, PETSC_TRUE), "declaring a matrix positive definite");
}

}  // namespace

std::vector<double> pinned_diagonal(const Matrix::Storage& A, std::span<const char> pinned) {
  const auto m = static_cast<std::size_t>(A.block);
  const auto owned = static_cast<std::size_t>(A.layout->owned) * m;
  in_agreement(A.layout->comm, [&] {
    if (pinned.size() != owned) throw std::invalid_argument("one mark per owned unknown tells which are pinned");
  });
  const auto diagonal_of = [&](std::size_t i) {
    return A.block_at(A.row_begin(static_cast<LocalIndex>(i / m)))[(i % m) * (m + 1)];
  };
  double largest = 0;
  for (std::size_t i = 0; i < owned; ++i) largest = std::max(largest, diagonal_of(i));
  largest = max_over_ranks(largest, A.layout->comm);
  if (!(largest > 0)) largest = 1;
  std::vector<double> result(A.global.size() * m, 0.0);
  for (std::size_t i = 0; i < owned; ++i)
    if (pinned[i]) result[i] = diagonal_of(i) > 0 ? diagonal_of(i) : largest;
  A.wide->exchange().to_ghosts(result, A.block);
  return result;
}

PinnedMatrix::PinnedMatrix(const Matrix::Storage& A) {
  const GlobalIndex unknowns = A.layout->global_size * A.block;
  if (unknowns > std::numeric_limits<PetscInt>::max())
    throw std::runtime_error("more unknowns than PETSc's 32-bit indices can number");
  create(A);
  declare_positive_definite(mat_);
}

PinnedMatrix::~PinnedMatrix() { MatDestroy(&mat_); }

void PinnedMatrix::create(const Matrix::Storage& A) {
  const LocalIndex owned = A.layout->owned;
  std::vector<PetscInt> blocks_here(static_cast<std::size_t>(owned), 0);
  std::vector<PetscInt> blocks_elsewhere = blocks_here;
  for (LocalIndex row = 0; row < owned; ++row)
    for (std::size_t k = A.row_begin(row); k < A.row_end(row); ++k)
      ++(A.column[k] < owned ? blocks_here : blocks_elsewhere)[static_cast<std::size_t>(row)];
  const PetscInt size = owned * A.block;
  petsc_check(MatCreateSBAIJ(A.layout->comm, A.block, size, size, PETSC_DETERMINE, PETSC_DETERMINE, 0,
                             blocks_here.data(), 0, blocks_elsewhere.data(), &mat_),
              "creating a distributed matrix");
  petsc_check(MatSetOption(mat_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE), "fixing a pattern");
  fill_rows(A);  // for PETSc the pattern exists only once it has values
}

void PinnedMatrix::fill(const Matrix::Storage& A, std::vector<double> pinned_diagonal, double shift) {
  diagonal_factor_ = 1 + shift;
  pinned_diagonal_ = std::move(pinned_diagonal);
  fill_rows(A);
}

void PinnedMatrix::fill_rows(const Matrix::Storage& A) {
  const auto m = static_cast<std::size_t>(A.block);
  if (pinned_diagonal_.empty()) pinned_diagonal_.assign(A.global.size() * m, 0.0);
  std::vector<PetscInt> columns;
  std::vector<double> values;
  for (LocalIndex row = 0; row < A.layout->owned; ++row) {
    const std::size_t begin = A.row_begin(row);
    const std::size_t width = (A.row_end(row) - begin) * m;
    columns.clear();
    values.assign(m * width, 0.0);
    for (std::size_t k = begin; k < A.row_end(row); ++k) {
      columns.push_back(static_cast<PetscInt>(A.global[static_cast<std::size_t>(A.column[k])]));
      double* target = values.data() + (k - begin) * m;
      for (std::size_t a = 0; a < m; ++a) std::copy_n(A.block_at(k) + a * m, m, target + a * width);
      replace_pinned(static_cast<std::size_t>(row) * m, static_cast<std::size_t>(A.column[k]) * m, m, target, width);
    }
    const auto row_global = static_cast<PetscInt>(A.global[static_cast<std::size_t>(row)]);
    petsc_check(MatSetValuesBlocked(mat_, 1, &row_global, static_cast<PetscInt>(columns.size()), columns.data(),
                                    values.data(), INSERT_VALUES),
                "filling a distributed matrix");
  }
  petsc_check(MatAssemblyBegin(mat_, MAT_FINAL_ASSEMBLY), "assembling a distributed matrix");
  petsc_check(MatAssemblyEnd(mat_, MAT_FINAL_ASSEMBLY), "assembling a distributed matrix");
}

// Applies the pins and the shift to one block. Its first unknowns are `row` and `column`, and its rows have distance
// `stride`.
void PinnedMatrix::replace_pinned(std::size_t row, std::size_t column, std::size_t block, double* values,
                                  std::size_t stride) const {
  for (std::size_t a = 0; a < block; ++a)
    for (std::size_t b = 0; b < block; ++b) {
      const bool is_diagonal = row + a == column + b;
      double& value = values[a * stride + b];
      if (pinned_diagonal_[row + a] != 0 || pinned_diagonal_[column + b] != 0)
        value = is_diagonal ? pinned_diagonal_[row + a] : 0.0;
      else if (is_diagonal)
        value *= diagonal_factor_;
    }
}

}  // namespace plastron::algebra

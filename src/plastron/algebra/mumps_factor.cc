#include <plastron/algebra/agreement.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "mumps_factor.hpp"

namespace plastron::algebra {

namespace {

constexpr int mumps_extra_memory = 14;         // ICNTL: working space beyond its estimate, in per cent
constexpr int mumps_negative_pivots = 12;      // INFOG: their number
constexpr int mumps_estimated_entries = 20;    // INFOG: entries of the factor, or minus their number in millions
constexpr int mumps_estimated_operations = 1;  // RINFOG
constexpr PetscInt mumps_null_pivot = -10;     // values of INFOG(1)
constexpr PetscInt mumps_negative_pivot_in_root = -40;

PetscInt mumps_info(Mat factor, int which) {
  PetscInt value = 0;
  petsc_check(MatMumpsGetInfog(factor, which, &value), "asking MUMPS how it went");
  return value;
}

FactorisationCost cost_of_mumps(Mat factor) {
  FactorisationCost cost;
  petsc_check(MatMumpsGetRinfog(factor, mumps_estimated_operations, &cost.operations), "asking MUMPS for its work");
  const PetscInt entries = mumps_info(factor, mumps_estimated_entries);
  cost.entries = entries >= 0 ? entries : -1e6 * entries;
  return cost;
}

// MUMPS estimates its memory from the pattern, and the estimate may be too small. Then the memory is doubled each time.
bool is_short_of_estimated_memory(PetscInt outcome) {
  return outcome == -8 || outcome == -9 || outcome == -14 || outcome == -15 || outcome == -17 || outcome == -20;
}

void declare_positive_definite(Mat mat) {
  petsc_check(MatSetOption(mat, MAT_SYMMETRIC, PETSC_TRUE), "declaring a matrix symmetric");
  petsc_check(MatSetOption(mat, MAT_SPD, PETSC_TRUE), "declaring a matrix positive definite");
}

}  // namespace

std::vector<double> fixed_diagonal(const MatrixStorage& A, std::span<const char> fixed) {
  const auto m = static_cast<std::size_t>(A.block);
  const auto owned = static_cast<std::size_t>(A.layout->owned) * m;
  in_agreement(A.layout->comm, [&] {
    if (fixed.size() != owned) throw std::invalid_argument("one mark per owned unknown tells which are fixed");
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
    if (fixed[i]) result[i] = diagonal_of(i) > 0 ? diagonal_of(i) : largest;
  A.wide->exchange().to_ghosts(result, A.block);
  return result;
}

PetscMatrix::PetscMatrix(const MatrixStorage& A) {
  const GlobalIndex unknowns = A.layout->global_size * A.block;
  if (unknowns > std::numeric_limits<PetscInt>::max())
    throw std::runtime_error("more unknowns than PETSc's 32-bit indices can number");
  create(A);
  declare_positive_definite(mat_);
}

PetscMatrix::~PetscMatrix() { MatDestroy(&mat_); }

void PetscMatrix::create(const MatrixStorage& A) {
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

void PetscMatrix::fill(const MatrixStorage& A, std::vector<double> fixed_diagonal, double shift) {
  diagonal_factor_ = 1 + shift;
  fixed_diagonal_ = std::move(fixed_diagonal);
  fill_rows(A);
}

void PetscMatrix::fill_rows(const MatrixStorage& A) {
  const auto m = static_cast<std::size_t>(A.block);
  if (fixed_diagonal_.empty()) fixed_diagonal_.assign(A.global.size() * m, 0.0);
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
      replace_fixed(static_cast<std::size_t>(row) * m, static_cast<std::size_t>(A.column[k]) * m, m, target, width);
    }
    const auto row_global = static_cast<PetscInt>(A.global[static_cast<std::size_t>(row)]);
    petsc_check(MatSetValuesBlocked(mat_, 1, &row_global, static_cast<PetscInt>(columns.size()), columns.data(),
                                    values.data(), INSERT_VALUES),
                "filling a distributed matrix");
  }
  petsc_check(MatAssemblyBegin(mat_, MAT_FINAL_ASSEMBLY), "assembling a distributed matrix");
  petsc_check(MatAssemblyEnd(mat_, MAT_FINAL_ASSEMBLY), "assembling a distributed matrix");
}

// Applies fixed unknowns and the shift to one block. Its first unknowns are `row` and `column`, and its rows have
// distance `stride`.
void PetscMatrix::replace_fixed(std::size_t row, std::size_t column, std::size_t block, double* values,
                                std::size_t stride) const {
  for (std::size_t a = 0; a < block; ++a)
    for (std::size_t b = 0; b < block; ++b) {
      const bool is_diagonal = row + a == column + b;
      double& value = values[a * stride + b];
      if (fixed_diagonal_[row + a] != 0 || fixed_diagonal_[column + b] != 0)
        value = is_diagonal ? fixed_diagonal_[row + a] : 0.0;
      else if (is_diagonal)
        value *= diagonal_factor_;
    }
}

MumpsFactor::MumpsFactor(const MatrixStorage& A)
    : A_(A), copy_(A), right_(*A.layout, A.block), solution_(*A.layout, A.block) {
  petsc_check(MatFactorInfoInitialize(&info_), "preparing a factorisation");
  analyse();
}

MumpsFactor::~MumpsFactor() { MatDestroy(&factor_); }

void MumpsFactor::analyse() {
  const PrivateOptions options;
  petsc_check(MatDestroy(&factor_), "dropping a factor");
  petsc_check(MatGetFactor(copy_.mat(), MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor_),
              "asking for a Cholesky factorisation");
  petsc_check(MatMumpsSetIcntl(factor_, mumps_extra_memory, extra_memory_), "setting MUMPS's memory");
  petsc_check(MatCholeskyFactorSymbolic(factor_, copy_.mat(), nullptr, &info_), "analysing the pattern of a matrix");
  cost_ = cost_of_mumps(factor_);
}

// PETSc blocks further calls of MUMPS after a failure. Therefore each failure is followed by a new analysis.
bool MumpsFactor::factorise(std::vector<double> fixed_diagonal, double shift) {
  copy_.fill(A_, std::move(fixed_diagonal), shift);
  for (;; extra_memory_ *= 2, analyse()) {
    petsc_check(MatCholeskyFactorNumeric(factor_, copy_.mat(), &info_), "factorising with MUMPS");
    const PetscInt outcome = mumps_info(factor_, 1);
    if (outcome >= 0) return mumps_info(factor_, mumps_negative_pivots) == 0;
    if (outcome == mumps_null_pivot || outcome == mumps_negative_pivot_in_root) {
      analyse();
      return false;
    }
    if (!is_short_of_estimated_memory(outcome) || extra_memory_ > 3000)
      throw std::runtime_error("MUMPS failed with INFOG(1) = " + std::to_string(outcome) +
                               ", INFOG(2) = " + std::to_string(mumps_info(factor_, 2)) +
                               "; out of memory is the usual reason: use more ranks or a coarser mesh");
  }
}

void MumpsFactor::solve(const Vector& b, Vector& x) const {
  const BorrowedVec::Loan right(right_, b.owned().data()), solution(solution_, x.owned().data());
  petsc_check(MatSolve(factor_, right_.vec(), solution_.vec()), "solving with a factorised matrix");
}

}  // namespace plastron::algebra

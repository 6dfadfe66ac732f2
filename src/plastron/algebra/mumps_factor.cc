#include "mumps_factor.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "petsc_check.hpp"
#include "private_options.hpp"

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

}  // namespace

MumpsFactor::MumpsFactor(const Matrix::Storage& A)
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
bool MumpsFactor::factorise(std::vector<double> pinned_diagonal, double shift) {
  copy_.fill(A_, std::move(pinned_diagonal), shift);
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

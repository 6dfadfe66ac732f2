#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/threads.hpp>

#include <stdexcept>

#include "borrowed_vec.hpp"
#include "petsc_check.hpp"
#include "petsc_use.hpp"
#include "pinned_matrix.hpp"
#include "private_options.hpp"

namespace plastron::algebra {
namespace {

constexpr int mumps_extra_memory = 14;         // ICNTL: working space beyond its estimate, in per cent
constexpr int mumps_negative_pivots = 12;      // INFOG: how many
constexpr int mumps_estimated_entries = 20;    // INFOG: of the factor, or minus their number in millions
constexpr int mumps_estimated_operations = 1;  // RINFOG
constexpr PetscInt mumps_null_pivot = -10;     // values of INFOG(1)
constexpr PetscInt mumps_negative_pivot_in_root = -40;

// CHOLMOD supernodal L L' always: it runs on the BLAS, and unlike the simplicial L D L' it notices negative pivots. The
// ordering is CHOLMOD's own choice of AMD and METIS. PETSc reads these options during the analysis.
Mat analyse(Mat mat, bool on_one_rank, PetscInt extra_memory, const MatFactorInfo& info) {
  PrivateOptions options;
  options.add("-mat_cholmod_factor", "SUPERNODAL");
  options.add("-mat_cholmod_print", "0");
  Mat factor = nullptr;
  petsc_check(MatGetFactor(mat, on_one_rank ? MATSOLVERCHOLMOD : MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor),
              "asking for a Cholesky factorisation");
  if (!on_one_rank) petsc_check(MatMumpsSetIcntl(factor, mumps_extra_memory, extra_memory), "setting MUMPS's memory");
  petsc_check(MatCholeskyFactorSymbolic(factor, mat, nullptr, &info), "analysing the pattern of a matrix");
  return factor;
}

PetscInt mumps_info(Mat factor, int which) {
  PetscInt value = 0;
  petsc_check(MatMumpsGetInfog(factor, which, &value), "asking MUMPS how it went");
  return value;
}

// CHOLMOD tells the entries l of the factor by PETSc and not the operations, the sum of the squares of the columns' lengths: at least
// l^2 / n, which holds for equal columns, and for matrices of shells 5 to 6 times that.
FactorisationCost cost_of_cholmod(Mat factor) {
  constexpr double unequal_columns = 5.5;
  MatInfo info;
  petsc_check(MatGetInfo(factor, MAT_LOCAL, &info), "asking CHOLMOD for the size of a factor");
  PetscInt size = 0;
  petsc_check(MatGetSize(factor, &size, nullptr), "asking for the size of a matrix");
  const double entries = info.nz_used;
  return {.operations = size > 0 ? unequal_columns * entries * entries / size : 0, .entries = entries};
}

FactorisationCost cost_of_mumps(Mat factor) {
  FactorisationCost cost;
  petsc_check(MatMumpsGetRinfog(factor, mumps_estimated_operations, &cost.operations), "asking MUMPS for its work");
  const PetscInt entries = mumps_info(factor, mumps_estimated_entries);
  cost.entries = entries >= 0 ? entries : -1e6 * entries;
  return cost;
}

// MUMPS foresees its memory from the pattern and may be wrong: more is granted, twice as much each time.
bool is_short_of_estimated_memory(PetscInt outcome) {
  return outcome == -8 || outcome == -9 || outcome == -14 || outcome == -15 || outcome == -17 || outcome == -20;
}

}  // namespace

struct Factorisation::Storage {
  explicit Storage(const Matrix::Storage& matrix) : A(matrix), copy(matrix) {
    MPI_Comm_size(A.layout->comm, &ranks);
    petsc_check(MatFactorInfoInitialize(&info), "preparing a factorisation");
    analyse_again();
  }
  ~Storage() { MatDestroy(&factor); }
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;

  void analyse_again() {
    const double start = MPI_Wtime();
    petsc_check(MatDestroy(&factor), "dropping a factor");
    factor = analyse(copy.mat(), ranks == 1, extra_memory, info);
    cost = ranks == 1 ? cost_of_cholmod(factor) : cost_of_mumps(factor);
    seconds_symbolic += MPI_Wtime() - start;
  }

  bool factorise_with_cholmod() {
    petsc_check(MatFactorClearError(factor), "restarting CHOLMOD");
    const PetscErrorCode code = MatCholeskyFactorNumeric(factor, copy.mat(), &info);
    if (code == PETSC_ERR_MAT_CH_ZRPVT) return false;
    petsc_check(code, "factorising with CHOLMOD");
    MatFactorError error = MAT_FACTOR_NOERROR;
    petsc_check(MatFactorGetError(factor, &error), "asking CHOLMOD how it went");
    return error == MAT_FACTOR_NOERROR;
  }

  // PETSc lets MUMPS do nothing more once it has failed, hence the new analysis after each failure.
  bool factorise_with_mumps() {
    for (;; extra_memory *= 2, analyse_again()) {
      petsc_check(MatCholeskyFactorNumeric(factor, copy.mat(), &info), "factorising with MUMPS");
      const PetscInt outcome = mumps_info(factor, 1);
      if (outcome >= 0) return mumps_info(factor, mumps_negative_pivots) == 0;
      if (outcome == mumps_null_pivot || outcome == mumps_negative_pivot_in_root) {
        analyse_again();
        return false;
      }
      if (!is_short_of_estimated_memory(outcome) || extra_memory > 3000)
        throw std::runtime_error("MUMPS failed with INFOG(1) = " + std::to_string(outcome) +
                                 ", INFOG(2) = " + std::to_string(mumps_info(factor, 2)) +
                                 "; out of memory is the usual reason: use more ranks or a coarser mesh");
    }
  }

  const Matrix::Storage& A;
  PinnedMatrix copy;
  int ranks = 1;
  PetscInt extra_memory = 50;
  Mat factor = nullptr;
  MatFactorInfo info{};
  FactorisationCost cost{};
  bool ready = false;
  int factorisations = 0;
  double seconds_symbolic = 0;
  double seconds_numeric = 0;
};

Factorisation::Factorisation(const Matrix& A) {
  const double start = MPI_Wtime();
  const PetscUse petsc;
  storage_ = std::make_unique<Storage>(A.storage());
  storage_->seconds_symbolic = MPI_Wtime() - start;  // with the pattern of the working copy
}

Factorisation::Factorisation(Factorisation&&) noexcept = default;
Factorisation& Factorisation::operator=(Factorisation&&) noexcept = default;
Factorisation::~Factorisation() = default;

bool Factorisation::factorise(std::span<const char> pinned, double shift) {
  Storage& s = *storage_;
  const double start = MPI_Wtime();
  const PetscUse petsc;
  s.copy.fill(s.A, pinned, shift);
  const BlasThreads threads(threads_for(s.cost.operations));
  s.ready = s.ranks == 1 ? s.factorise_with_cholmod() : s.factorise_with_mumps();
  s.seconds_numeric += MPI_Wtime() - start;
  ++s.factorisations;
  return s.ready;
}

void Factorisation::solve(const Vector& b, Vector& x) const {
  const Storage& s = *storage_;
  if (!s.ready) throw std::logic_error("solve needs a factorise() that returned true");
  PLASTRON_ASSERT(&b != &x, &b, &x);
  PLASTRON_ASSERT(b.owned().size() == s.A.owned_unknowns() && x.owned().size() == s.A.owned_unknowns(),
                  b.owned().size(), x.owned().size(), s.A.owned_unknowns());
  const PetscUse petsc;
  const BorrowedVec rhs(*s.A.layout, s.A.block, b.owned().data());
  const BorrowedVec solution(*s.A.layout, s.A.block, x.owned().data());
  petsc_check(MatSolve(s.factor, rhs.vec(), solution.vec()), "solving with a factorised matrix");
}

// A solve waits for memory, hence the weight of an entry: operations of a factorisation by one thread that take as long as one entry of the
// factor in a solve (benchmarks/step_cost; docs/performance.md).
Price price_of(const FactorisationCost& cost) {
  constexpr double per_entry = 65;
  return {.pin = cost.operations / threads_for(cost.operations), .apply = per_entry * cost.entries};
}

Pinning Factorisation::pin(std::span<const char> pinned, double shift) {
  return factorise(pinned, shift) ? Pinning::done : Pinning::not_positive_definite;
}

SoftestMotion Factorisation::softest_motion(const Operator& operate, std::span<const char> pinned,
                                            const Vector& diagonal) const {
  return algebra::softest_motion(operate, *this, pinned, diagonal);
}

FactorisationCost Factorisation::cost() const { return storage_->cost; }
int Factorisation::factorisations() const { return storage_->factorisations; }
double Factorisation::seconds_symbolic() const { return storage_->seconds_symbolic; }
double Factorisation::seconds_numeric() const { return storage_->seconds_numeric; }

}  // namespace plastron::algebra

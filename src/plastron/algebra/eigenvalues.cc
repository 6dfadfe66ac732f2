#include <plastron/algebra/eigenvalues.hpp>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/pseudo_random.hpp>

#include <slepceps.h>

#include <algorithm>
#include <exception>
#include <functional>

#include "petsc_use.hpp"

namespace plastron::algebra {
namespace {

// The free unknowns in a PETSc vector, without the others.
class FreeUnknowns {
 public:
  explicit FreeUnknowns(const SelfAdjointOperator& T) : layout_(T.layout), block_(T.block) {
    const auto owned = static_cast<std::size_t>(layout_->owned) * static_cast<std::size_t>(block_);
    for (std::size_t i = 0; i < owned; ++i)
      if (T.fixed.empty() || !T.fixed[i]) free_.push_back(i);
  }

  PetscInt size() const { return static_cast<PetscInt>(free_.size()); }
  std::int64_t global_size() const { return sum_over_ranks(static_cast<std::int64_t>(free_.size()), layout_->comm); }
  Vector zero() const { return {layout_, block_}; }

  void expand(Vec from, Vector& to) const {
    const double* values = nullptr;
    petsc_check(VecGetArrayRead(from, &values), "reading a vector");
    to.fill(0);
    for (std::size_t k = 0; k < free_.size(); ++k) to.owned()[free_[k]] = values[k];
    petsc_check(VecRestoreArrayRead(from, &values), "ending the reading of a vector");
    to.update_ghosts();
  }
  void compress(const Vector& from, Vec to) const {
    double* values = nullptr;
    petsc_check(VecGetArray(to, &values), "writing a vector");
    for (std::size_t k = 0; k < free_.size(); ++k) values[k] = from.owned()[free_[k]];
    petsc_check(VecRestoreArray(to, &values), "ending the writing of a vector");
  }

 private:
  std::shared_ptr<const Layout> layout_;
  int block_;
  std::vector<std::size_t> free_{};
};

// One of our operators between PETSc vectors. An exception must not pass through SLEPc: it is kept until SLEPc has
// returned.
struct Adapter {
  const Operator& apply;
  const FreeUnknowns& unknowns;
  Vector x{unknowns.zero()}, y{unknowns.zero()};
  int applications = 0;
  std::exception_ptr failure{};

  PetscErrorCode operator()(Vec from, Vec to) noexcept {
    try {
      unknowns.expand(from, x);
      apply(x, y);
      unknowns.compress(y, to);
      ++applications;
      return 0;
    } catch (...) {
      failure = std::current_exception();
      return PETSC_ERR_USER;
    }
  }
};

PetscErrorCode multiply(Mat mat, Vec x, Vec y) {
  void* context = nullptr;
  if (const PetscErrorCode code = MatShellGetContext(mat, &context)) return code;
  return (*static_cast<Adapter*>(context))(x, y);
}

// SLEPc's solver for one problem. SLEPc solves A x = theta B x and applies B^{-1} A. We have T = B^{-1} A directly.
// Therefore T replaces A, the identity replaces B^{-1}, and B is used for the inner product only.
class Solver {
 public:
  Solver(const SelfAdjointOperator& T, End end)
      : comm_(T.layout->comm), unknowns_(T), T_{T.apply, unknowns_}, B_{T.inner_product, unknowns_} {
    create_shell(T_, &T_mat_);
    create_shell(B_, &B_mat_);
    petsc_check(EPSCreate(comm_, &eps_), "creating an eigenvalue solver");
    petsc_check(EPSSetOperators(eps_, T_mat_, B_mat_), "setting an eigenvalue problem");
    petsc_check(EPSSetProblemType(eps_, EPS_GHEP), "declaring an eigenvalue problem symmetric");
    petsc_check(EPSSetType(eps_, EPSKRYLOVSCHUR), "choosing an eigenvalue solver");
    petsc_check(EPSSetWhichEigenpairs(eps_, end == End::smallest ? EPS_SMALLEST_REAL : EPS_LARGEST_REAL),
                "choosing an end of the spectrum");
    leave_out_inverse();
  }
  ~Solver() {
    EPSDestroy(&eps_);
    MatDestroy(&T_mat_);
    MatDestroy(&B_mat_);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  std::int64_t size() const { return unknowns_.global_size(); }
  int applications() const { return T_.applications; }

  // Solves in the complement of the vectors in `found`.
  Eigenpairs solve(int count, const EigenSettings& settings, const Eigenpairs& found, std::uint64_t seed) {
    const int basis = static_cast<int>(
        std::min<std::int64_t>(size() - static_cast<std::int64_t>(found.values.size()), 2 * count + 30));
    petsc_check(EPSSetDimensions(eps_, std::min(count, basis), basis, PETSC_DEFAULT), "sizing an eigenvalue solver");
    petsc_check(EPSSetTolerances(eps_, settings.tolerance, settings.max_restarts), "setting a tolerance");
    start_from_pseudo_random_values(seed);
    deflate(found);
    const PetscErrorCode code = EPSSolve(eps_);
    for (const Adapter* adapter : {&T_, &B_})
      if (adapter->failure) std::rethrow_exception(adapter->failure);
    // The inner product of some vector with itself is not positive, up to rounding.
    if (code == PETSC_ERR_USER_INPUT) return {};
    petsc_check(code, "computing eigenvalues");
    return result(std::min(count, basis));
  }

 private:
  void leave_out_inverse() {
    ST st = nullptr;
    KSP ksp = nullptr;
    PC pc = nullptr;
    petsc_check(EPSGetST(eps_, &st), "reaching a spectral transformation");
    petsc_check(STSetType(st, STSHIFT), "setting a spectral transformation");
    petsc_check(STGetKSP(st, &ksp), "reaching a spectral transformation");
    petsc_check(KSPSetType(ksp, KSPPREONLY), "setting a spectral transformation");
    petsc_check(KSPGetPC(ksp, &pc), "reaching a spectral transformation");
    petsc_check(PCSetType(pc, PCNONE), "setting a spectral transformation");
  }

  void create_shell(Adapter& adapter, Mat* mat) {
    petsc_check(
        MatCreateShell(comm_, unknowns_.size(), unknowns_.size(), PETSC_DETERMINE, PETSC_DETERMINE, &adapter, mat),
        "wrapping an operator");
    petsc_check(MatShellSetOperation(*mat, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)), "wrapping an operator");
    petsc_check(MatSetOption(*mat, MAT_SYMMETRIC, PETSC_TRUE), "wrapping an operator");
  }

  Vec create_vec() const {
    Vec vec = nullptr;
    petsc_check(VecCreateMPI(comm_, unknowns_.size(), PETSC_DETERMINE, &vec), "creating a vector");
    return vec;
  }

  void start_from_pseudo_random_values(std::uint64_t seed) {
    Vector start = unknowns_.zero();
    fill_with_pseudo_random_values(start, seed);
    Vec vec = create_vec();
    unknowns_.compress(start, vec);
    petsc_check(EPSSetInitialSpace(eps_, 1, &vec), "starting an eigenvalue solver");
    petsc_check(VecDestroy(&vec), "dropping a vector");
  }

  void deflate(const Eigenpairs& found) {
    std::vector<Vec> vecs;
    for (const Vector& v : found.vectors) {
      vecs.push_back(create_vec());
      unknowns_.compress(v, vecs.back());
    }
    if (vecs.empty()) return;
    petsc_check(EPSSetDeflationSpace(eps_, static_cast<PetscInt>(vecs.size()), vecs.data()),
                "setting known eigenvectors");
    for (Vec& vec : vecs) petsc_check(VecDestroy(&vec), "dropping a vector");
  }

  Eigenpairs result(int wanted) {
    PetscInt converged = 0;
    petsc_check(EPSGetConverged(eps_, &converged), "asking how many eigenvalues converged");
    Eigenpairs pairs{.converged = converged >= wanted};
    Vec vec = create_vec();
    for (PetscInt i = 0; i < std::min<PetscInt>(converged, wanted); ++i) {
      double value = 0;
      petsc_check(EPSGetEigenpair(eps_, i, &value, nullptr, vec, nullptr), "taking an eigenvector");
      pairs.values.push_back(value);
      pairs.vectors.push_back(unknowns_.zero());
      unknowns_.expand(vec, pairs.vectors.back());
    }
    petsc_check(VecDestroy(&vec), "dropping a vector");
    return pairs;
  }

  MPI_Comm comm_;
  FreeUnknowns unknowns_;
  Adapter T_, B_;
  Mat T_mat_ = nullptr, B_mat_ = nullptr;
  EPS eps_ = nullptr;
};

void insert(Eigenpairs& pairs, End end, const Eigenpairs& next) {
  const auto place = end == End::smallest ? std::ranges::upper_bound(pairs.values, next.values[0])
                                          : std::ranges::upper_bound(pairs.values, next.values[0], std::greater{});
  pairs.vectors.insert(pairs.vectors.begin() + (place - pairs.values.begin()), next.vectors[0]);
  pairs.values.insert(place, next.values[0]);
}

// A Krylov space from one vector contains one vector of every eigenspace. The others of a multiple eigenvalue enter by
// rounding only. Therefore we compute the next eigenvalue in the complement of the eigenvectors found. We stop when it
// is not one that should have been found before.
void find_multiples(const SelfAdjointOperator& T, End end, const EigenSettings& settings, Eigenpairs& pairs) {
  const double sign = end == End::smallest ? 1 : -1;
  for (std::uint64_t seed = 1; pairs.converged; ++seed) {
    Solver solver(T, end);
    if (solver.size() <= static_cast<std::int64_t>(pairs.values.size())) return;
    const Eigenpairs next = solver.solve(1, settings, pairs, seed);
    pairs.applications += solver.applications();
    pairs.converged = next.converged;
    if (!next.converged) return;
    const double last = pairs.values.back();
    if (sign * (next.values[0] - last) >= -10 * settings.tolerance * std::abs(last)) return;
    insert(pairs, end, next);
    pairs.values.pop_back();
    pairs.vectors.pop_back();
  }
}

/// Passes through SLEPc as an exception of the operator.
struct Stopped {};

Eigenpairs pairs_of(const SelfAdjointOperator& T, End end, const EigenSettings& settings) {
  const PetscUse petsc;
  Solver solver(T, end);
  const int count = static_cast<int>(std::min<std::int64_t>(settings.count, solver.size()));
  if (count == 0) return {.converged = true};
  Eigenpairs pairs = solver.solve(count, settings, {}, 0);
  pairs.applications = solver.applications();
  if (count > 1) find_multiples(T, end, settings, pairs);
  return pairs;
}

}  // namespace

Eigenpairs eigenpairs(const SelfAdjointOperator& T, End end, const EigenSettings& settings) {
  if (!settings.stop) return pairs_of(T, end, settings);
  SelfAdjointOperator stoppable = T;
  stoppable.apply = [&](const Vector& x, Vector& y) {
    if (settings.stop()) throw Stopped();
    T.apply(x, y);
  };
  try {
    return pairs_of(stoppable, end, settings);
  } catch (const Stopped&) {
    return {.was_stopped = true};
  }
}

Eigenpairs smallest_eigenpairs(const Matrix& A, const Matrix& B, std::span<const char> fixed, double shift,
                               const EigenSettings& settings) {
  const Matrix shifted = A.plus_multiple(shift, B);
  Factorisation factor(shifted);
  if (!factor.factorise(fixed)) return {};
  Vector Bx(A.layout(), A.block());
  const Operator apply = [&](const Vector& x, Vector& y) {
    B.multiply(x, Bx);
    factor.solve(Bx, y);
  };
  const Operator inner_product = [&](const Vector& x, Vector& y) { B.multiply(x, y); };
  Eigenpairs pairs = eigenpairs({A.layout(), A.block(), apply, inner_product, fixed}, End::largest, settings);
  for (double& value : pairs.values) value = 1 / value - shift;
  return pairs;
}

}  // namespace plastron::algebra

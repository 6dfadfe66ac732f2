#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/threads.hpp>

#include <stdexcept>

#include "mumps_factor.hpp"
#include "petsc_use.hpp"
#include "supernodal_factor.hpp"

namespace plastron::algebra {

/// One of the two factors, depending on the number of ranks.
struct Factorisation::Storage {
  explicit Storage(const MatrixStorage& matrix) : A(matrix) {}

  const MatrixStorage& A;
  std::unique_ptr<SupernodalFactor> alone{};
  std::unique_ptr<MumpsFactor> together{};
  bool ready = false;
  int factorisations = 0;
  double seconds_symbolic = 0;
  double seconds_numeric = 0;
};

Factorisation::Factorisation(const Matrix& A, std::span<const char> movable)
    : storage_(std::make_unique<Storage>(A.storage())) {
  const double start = MPI_Wtime();
  const PetscUse petsc;
  int ranks = 1;
  MPI_Comm_size(storage_->A.layout->comm, &ranks);
  PLASTRON_ASSERT(movable.empty() || movable.size() == storage_->A.owned_unknowns(), movable.size());
  if (ranks == 1)
    storage_->alone = std::make_unique<SupernodalFactor>(storage_->A, movable);
  else
    storage_->together = std::make_unique<MumpsFactor>(storage_->A);
  storage_->seconds_symbolic = MPI_Wtime() - start;
}

Factorisation::Factorisation(Factorisation&&) noexcept = default;
Factorisation& Factorisation::operator=(Factorisation&&) noexcept = default;
Factorisation::~Factorisation() = default;

bool Factorisation::factorise(std::span<const char> fixed, double shift) {
  Storage& s = *storage_;
  const double start = MPI_Wtime();
  const PetscUse petsc;
  const auto diagonal = fixed_diagonal(s.A, fixed);
  if (s.alone) {
    s.ready = s.alone->factorise(diagonal, shift);
    s.factorisations = s.alone->factorisations();
    s.seconds_numeric = s.alone->seconds();
  } else {
    s.ready = s.together->factorise(diagonal, shift);
    ++s.factorisations;
    s.seconds_numeric += MPI_Wtime() - start;
  }
  return s.ready;
}

void Factorisation::solve(const Vector& b, Vector& x) const {
  const Storage& s = *storage_;
  if (!s.ready) throw std::logic_error("solve needs a factorise() that returned true");
  PLASTRON_ASSERT(&b != &x, &b, &x);
  PLASTRON_ASSERT(b.owned().size() == s.A.owned_unknowns() && x.owned().size() == s.A.owned_unknowns(),
                  b.owned().size(), x.owned().size(), s.A.owned_unknowns());
  if (s.alone) return s.alone->solve(b.owned(), x.owned());
  const PetscUse petsc;
  s.together->solve(b, x);
}

std::vector<char> Factorisation::nearest_fixed(std::span<const char> wanted) const {
  return storage_->alone ? storage_->alone->nearest_fixed(wanted) : std::vector<char>{};
}

// Memory access takes time, hence weights of an entry. The unit is an operation of a factorisation by one thread. The
// weights give the time of one entry of the factor besides its operations, and in a solve
// (benchmarks/step_cost; docs/performance.md).
SoftestMotion Factorisation::softest_motion(const Operator& operate, std::span<const char> fixed,
                                            const Vector& diagonal) const {
  const Operator inverse = [this](const Vector& r, Vector& z) { solve(r, z); };
  return algebra::softest_motion(operate, inverse, fixed, diagonal);
}

FactorisationCost Factorisation::cost() const {
  return storage_->alone ? storage_->alone->cost() : storage_->together->cost();
}
int Factorisation::factorisations() const { return storage_->factorisations; }
double Factorisation::seconds_symbolic() const { return storage_->seconds_symbolic; }
double Factorisation::seconds_numeric() const { return storage_->seconds_numeric; }

}  // namespace plastron::algebra

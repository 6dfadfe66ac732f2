// Cholesky factorisation of a matrix with some unknowns pinned: CHOLMOD on one rank, MUMPS on several.
// The symbolic analysis is done once and serves every set of pinned unknowns, since the pattern stays.
#pragma once
#include <plastron/algebra/matrix.hpp>

#include <memory>
#include <span>

namespace plastron::algebra {

/// As the analysis of the pattern foresees it, the same in every run; over all ranks.
struct FactorisationCost {
  double operations = 0;  ///< of one numeric factorisation
  double entries = 0;     ///< of the factor: a solve reads each of them twice
};

class Factorisation {
 public:
  /// Symbolic analysis of the pattern of A (collective). A must outlive this object.
  explicit Factorisation(const Matrix& A);
  Factorisation(Factorisation&&) noexcept;
  Factorisation& operator=(Factorisation&&) noexcept;
  ~Factorisation();

  /// Factorises A with the rows and columns of the pinned unknowns replaced by those of a diagonal matrix.
  /// pinned[i] != 0 for the owned scalar unknown i. The diagonal keeps A's entry where that is positive, and takes A's
  /// largest elsewhere. False if a pivot is not positive. A matrix that is singular up to rounding may pass: see
  /// softest_motion. (collective)
  bool factorise(std::span<const char> pinned);
  /// x = F^{-1} b for the factorised F; on pinned unknowns x = b / (their diagonal). Owned values. (collective)
  void solve(const Vector& b, Vector& x) const;

  FactorisationCost cost() const;
  int factorisations() const;  ///< numeric factorisations so far
  double seconds_symbolic() const;
  double seconds_numeric() const;  ///< all of them together

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

}  // namespace plastron::algebra

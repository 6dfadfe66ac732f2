// Cholesky factorisation of a matrix with some unknowns pinned: CHOLMOD on one rank, MUMPS on several.
// The symbolic analysis is done once and serves every set of pinned unknowns, since the pattern stays.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/algebra/preconditioner.hpp>

#include <memory>
#include <span>
#include <vector>

namespace plastron::algebra {

/// As the analysis of the pattern foresees it, the same in every run; over all ranks.
struct FactorisationCost {
  double operations = 0;  ///< of one numeric factorisation
  double entries = 0;     ///< of the factor: a solve reads each of them twice
  /// That an unknown's own entries lead to, one after the other to the last unknown: what a solve of one equation reads. Mean; 0 if not known.
  double entries_of_path = 0;
};

/// What that amounts to beside other preconditioners.
Price price_of(const FactorisationCost& cost);

class Factorisation : public Preconditioner {
 public:
  /// Symbolic analysis of the pattern of A (collective). A must outlive this object. movable[i] != 0 for owned unknowns whose pins will
  /// probably change, some hundreds of them: once A is factorised, pinning others of these alone is a dense problem of their number and no
  /// factorisation. Empty: none. Several ranks have no such shortcut.
  explicit Factorisation(const Matrix& A, std::span<const char> movable = {});
  Factorisation(Factorisation&&) noexcept;
  Factorisation& operator=(Factorisation&&) noexcept;
  ~Factorisation() override;

  /// Factorises A + shift diag(A) with the rows and columns of the pinned unknowns replaced by those of a diagonal matrix.
  /// pinned[i] != 0 for the owned scalar unknown i. The diagonal keeps A's entry where that is positive, and takes A's
  /// largest elsewhere. False if a pivot is not positive. A matrix that is singular up to rounding may pass: see
  /// softest_motion. (collective)
  bool factorise(std::span<const char> pinned, double shift = 0);
  /// x = F^{-1} b for the factorised F; on pinned unknowns x = b / (their diagonal). Owned values. (collective)
  void solve(const Vector& b, Vector& x) const;

  // As a preconditioner: factorise() and solve() by their general names.
  Pinning pin(std::span<const char> pinned, double shift) override;
  void apply(const Vector& r, Vector& z) const override { solve(r, z); }
  bool is_exact() const override { return true; }
  std::vector<char> nearest_pins(std::span<const char> wanted) const override;
  SoftestMotion softest_motion(const Operator& operate, std::span<const char> pinned,
                               const Vector& diagonal) const override;
  Price price() const override { return price_of(cost()); }

  FactorisationCost cost() const;
  int factorisations() const;  ///< numeric factorisations so far, those of movable unknowns alone not counted
  double seconds_symbolic() const;
  double seconds_numeric() const;  ///< all of them together

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

}  // namespace plastron::algebra

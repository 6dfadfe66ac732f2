// Cholesky factorisation of a matrix with some unknowns fixed: CHOLMOD on one rank, MUMPS on several.
// The symbolic analysis is done once and serves every set of fixed unknowns, since the pattern stays.
#pragma once
#include <plastron/algebra/factorisation_cost.hpp>
#include <plastron/algebra/matrix.hpp>
#include <plastron/algebra/preconditioner.hpp>

#include <memory>
#include <span>
#include <vector>

namespace plastron::algebra {

class Factorisation : public Preconditioner {
 public:
  /// Analyses the pattern of A symbolically (collective). A must outlive this object. movable[i] != 0 for owned
  /// unknowns that will probably be fixed or released, some hundreds of them. After a factorisation of A, a change of
  /// these alone is a dense problem of their number and needs no factorisation. Empty: none. Several ranks have no such
  /// shortcut.
  explicit Factorisation(const Matrix& A, std::span<const char> movable = {});
  Factorisation(Factorisation&&) noexcept;
  Factorisation& operator=(Factorisation&&) noexcept;
  ~Factorisation() override;

  /// Factorises A + shift diag(A). A diagonal matrix replaces the rows and columns of the fixed unknowns.
  /// fixed[i] != 0 for the owned scalar unknown i. The diagonal keeps A's entry where it is positive, and takes A's
  /// largest elsewhere. Returns false if a pivot is not positive. A matrix that is singular up to rounding may pass:
  /// see softest_motion. (collective)
  bool factorise(std::span<const char> fixed, double shift = 0);
  /// Computes x = F^{-1} b for the factorised F; on fixed unknowns x = b / (their diagonal). Owned values.
  /// (collective)
  void solve(const Vector& b, Vector& x) const;

  // Interface of the preconditioner: factorise() and solve() by their general names.
  bool fix(std::span<const char> fixed, double shift) override { return factorise(fixed, shift); }
  void apply(const Vector& r, Vector& z) const override { solve(r, z); }
  std::vector<char> nearest_fixed(std::span<const char> wanted) const override;
  SoftestMotion softest_motion(const Operator& operate, std::span<const char> fixed,
                               const Vector& diagonal) const override;
  Price price() const override { return price_of(cost()); }

  FactorisationCost cost() const;
  int factorisations() const;  ///< numeric factorisations so far, without changes of movable unknowns alone
  double seconds_symbolic() const;
  double seconds_numeric() const;  ///< total time of all of them [s]

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

}  // namespace plastron::algebra

// Interface of A^{-1}, exact up to rounding, while some unknowns are fixed. It separates the code that chooses them
// (contact) from the code that solves.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/softest_motion.hpp>
#include <plastron/algebra/vector.hpp>

#include <span>
#include <vector>

namespace plastron::algebra {

/// Costs in operations of a factorisation by one thread. They are counts, equal in every run.
struct Price {
  double fix = 0;    ///< cost of preparing it for another set of fixed unknowns
  double apply = 0;  ///< cost of one application
};

/// A preconditioner of one matrix A, which its constructor gets. A must outlive it.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;

  /// Prepares it for A + shift diag(A), shift >= 0, with the unknowns fixed for which fixed[i] != 0 (owned scalar
  /// unknowns). Returns false if that matrix is not positive definite: some motion of the others has no energy. Then it
  /// cannot be applied before the next fix(). All ranks get the same result. (collective)
  virtual bool fix(std::span<const char> fixed, double shift) = 0;
  /// Returns the set nearest to `wanted` that costs little to fix from the present state; empty if no set does.
  virtual std::vector<char> nearest_fixed(std::span<const char> /*wanted*/) const { return {}; }
  /// Computes z = M^{-1} r with M symmetric and positive definite, on the unknowns that are not fixed A up to rounding.
  /// Then few steps of conjugate gradients are sufficient. After some more unknowns were fixed or released, nearly as
  /// many additional steps are needed. Zero where r is zero on fixed unknowns. Owned values. (collective)
  virtual void apply(const Vector& r, Vector& z) const = 0;
  /// Returns the motion of least stiffness while `fixed` is fixed. Call it after fix(). It finds motions whose
  /// stiffness is only rounding. `operate` is A as an operator, `diagonal` A's. (collective)
  virtual SoftestMotion softest_motion(const Operator& operate, std::span<const char> fixed,
                                       const Vector& diagonal) const = 0;
  virtual Price price() const = 0;

 protected:
  Preconditioner() = default;
  Preconditioner(const Preconditioner&) = default;
  Preconditioner(Preconditioner&&) = default;
  Preconditioner& operator=(const Preconditioner&) = default;
  Preconditioner& operator=(Preconditioner&&) = default;
};

}  // namespace plastron::algebra

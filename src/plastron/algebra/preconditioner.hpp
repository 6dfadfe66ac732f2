// Interface of an approximation of A^{-1} while some unknowns are pinned. It separates the code that chooses them
// (contact) from the code that solves. A factorisation is exact and expensive, a domain decomposition is neither.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/softest_motion.hpp>
#include <plastron/algebra/vector.hpp>

#include <span>
#include <vector>

namespace plastron::algebra {

enum class Pinning {
  done,
  not_positive_definite,  ///< some motion of the unknowns that are not pinned has zero or negative energy
  not_finite,             ///< the matrix contains numbers that are not finite
  not_converged           ///< the preparation of the preconditioner is an iteration, and it stalled
};

/// Costs in operations of a factorisation by one thread. They are counts, equal in every run.
struct Price {
  double pin = 0;    ///< cost of preparing it for another set of pinned unknowns
  double apply = 0;  ///< cost of one application
};

/// A preconditioner of one matrix A, which its constructor gets. A must outlive it.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;

  /// Prepares it for A + shift diag(A), shift >= 0, with the unknowns pinned for which pinned[i] != 0 (owned scalar
  /// unknowns). After any result except `done` it cannot be applied before the next pin(). All ranks get the same
  /// result. (collective)
  virtual Pinning pin(std::span<const char> pinned, double shift) = 0;
  /// Returns the set of pins nearest to `wanted` that costs little from the present state; empty if only new pinning is
  /// possible.
  virtual std::vector<char> nearest_pins(std::span<const char> /*wanted*/) const { return {}; }
  /// Computes z = M^{-1} r with M symmetric and positive definite, nearly A on the unknowns that are not pinned. Zero
  /// where r is zero on pinned unknowns. Owned values. (collective)
  virtual void apply(const Vector& r, Vector& z) const = 0;
  /// Whether M is A up to rounding. Then few steps of conjugate gradients are sufficient. After some more unknowns were
  /// pinned or released, nearly as many additional steps are needed.
  virtual bool is_exact() const = 0;
  /// Returns the motion of least stiffness while `pinned` is pinned. Call it after pin(). It finds motions whose
  /// stiffness is only rounding. `operate` is A as an operator, `diagonal` A's. (collective)
  virtual SoftestMotion softest_motion(const Operator& operate, std::span<const char> pinned,
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

// What a solver asks of an approximation of A^{-1} while some unknowns are held. It is the seam between those who choose what is held
// (contact) and those who solve: a factorisation is exact and dear, a domain decomposition neither.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/softest_motion.hpp>
#include <plastron/algebra/vector.hpp>

#include <span>
#include <vector>

namespace plastron::algebra {

enum class Pinning {
  done,
  not_positive_definite,  ///< some motion of the unknowns that are not pinned costs no energy, or less
  not_finite,             ///< the matrix has numbers that are none
  not_converged           ///< what prepares the preconditioner is itself an iteration, and it stalled
};

/// In operations of a factorisation by one thread; by counts, the same in every run.
struct Price {
  double pin = 0;    ///< of making it ready for another set of pinned unknowns
  double apply = 0;  ///< of one application
};

/// Belongs to one matrix A, which its constructor is given; A must outlive it.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;

  /// Makes it ready for A + shift diag(A), shift >= 0, with the unknowns pinned for which pinned[i] != 0 (owned scalar unknowns). After
  /// anything but `done` it cannot be applied before the next pin(). All ranks are told the same. (collective)
  virtual Pinning pin(std::span<const char> pinned, double shift) = 0;
  /// Of all sets of pins that can be had at little cost from where it stands the one nearest to `wanted`; empty if none but pinning anew.
  virtual std::vector<char> nearest_pins(std::span<const char> /*wanted*/) const { return {}; }
  /// z = M^{-1} r with M symmetric and positive definite, about A on the unknowns that are not pinned. Zero where r is zero on
  /// pinned unknowns. Owned values. (collective)
  virtual void apply(const Vector& r, Vector& z) const = 0;
  /// Whether M is A but for rounding. Then few steps of conjugate gradients do, and after some more unknowns were pinned or let go
  /// about as many steps as those.
  virtual bool is_exact() const = 0;
  /// The motion that costs least while `pinned` is pinned, to be asked after pin(): it finds the motions that rounding alone holds.
  /// `operate` is A as an operator, `diagonal` A's. (collective)
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

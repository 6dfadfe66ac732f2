// The motion of least stiffness. It distinguishes a structure that can move freely from one that is only thin: both
// factorisations may succeed, but a free motion has no stiffness at all.
#pragma once
#include <plastron/algebra/krylov.hpp>

#include <span>

namespace plastron::algebra {

struct SoftestMotion {
  Vector motion;                ///< v, scaled to v' D v = 1 with D the diagonal of A; zero if every unknown is fixed
  double stiffness = 1;         ///< v' A v, with the operator
  double factor_stiffness = 1;  ///< v' F v, with the factorised matrix

  /// Whether the stiffness of v is only rounding. Then A is singular on the unknowns that are not fixed, even if the
  /// factorisation succeeded because of rounding errors. For a rigid motion, an operator that computes strains first
  /// gives 1e-20 or less. F is rounded and gives about 1e-16. For a fixed structure the two agree.
  bool is_free() const;
};

/// Computes the motion by two steps of inverse iteration from arbitrary values. `apply` is A, `solve` the inverse of F,
/// factorised while the unknowns of `fixed` are fixed; it is applied twice. (collective)
SoftestMotion softest_motion(const Operator& apply, const Operator& solve, std::span<const char> fixed,
                             const Vector& diagonal);

}  // namespace plastron::algebra

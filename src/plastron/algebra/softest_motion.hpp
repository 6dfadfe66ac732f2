// The motion that costs least energy. It tells a structure that can move freely from one that is merely thin: both
// factorisations may go through, but a free motion has no stiffness at all.
#pragma once
#include <plastron/algebra/krylov.hpp>

#include <span>

namespace plastron::algebra {

class Preconditioner;

struct SoftestMotion {
  Vector motion;                ///< v, scaled to v' D v = 1 with D the diagonal of A; zero if every unknown is fixed
  double stiffness = 1;         ///< v' A v, with the operator
  double factor_stiffness = 1;  ///< v' F v, with the matrix that was factorised

  /// True if v costs nothing but rounding: A is singular on the unknowns that are not fixed, even if the factorisation
  /// went through on rounding errors. An operator that computes strains first gives 1e-20 or less for a rigid motion
  /// where F, being rounded, gives about 1e-16; for a structure that is held the two agree.
  bool is_free() const;
};

/// Two steps of inverse iteration from arbitrary values; costs two applications of an exact preconditioner, which `fixed` was
/// pinned in. (collective)
SoftestMotion softest_motion(const Operator& apply, const Preconditioner& factor, std::span<const char> fixed,
                             const Vector& diagonal);

}  // namespace plastron::algebra

// Settings of the contact solvers.
#pragma once

namespace plastron::contact {

/// Whether a subproblem near the factorised one is solved with the factor at hand.
enum class KeptFactor { where_cheaper, always };

struct Settings {
  int max_iterations = 200;  ///< active-set changes on one mesh; each costs one factorisation
  double gap_tolerance =
      1e-11;  ///< a bound counts as violated beyond this multiple of the largest unknown with a bound
  double multiplier_tolerance = 1e-10;  ///< a multiplier counts as negative beyond this multiple of the largest one
  double linear_tolerance = 1e-12;      ///< relative residual, in the preconditioner's norm, of the linear solves
  /// Look for motions that only rounding holds, at the cost of two solves a step. Needless once the bounds that never move are
  /// known to hold the structure.
  bool detect_free_motions = true;
  KeptFactor kept_factor = KeptFactor::where_cheaper;
  int max_refinement_steps = 30;   ///< conjugate-gradient steps of one linear solve with an exact preconditioner
  int max_iterative_steps = 2000;  ///< the same with one that is not exact
};

}  // namespace plastron::contact

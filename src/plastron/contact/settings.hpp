// Settings of the contact solvers.
#pragma once
#include <array>
#include <string_view>

namespace plastron::contact {

/// The contact solver. All find the same solution; each can check the others (solve.hpp).
enum class Solver {
  active_set,  ///< primal-dual active sets, one factorisation for each set (primal_dual_active_set.hpp)
  projected,   ///< the safeguarded search, one factorisation for each set (projected_search.hpp)
  tao,         ///< PETSc's bounded Newton method with a line search, TAOBNLS (tao.hpp)
  snesvi,      ///< PETSc's reduced-space Newton method for variational inequalities, SNESVINEWTONRSLS (snesvi.hpp)
  mprgp        ///< proportioning with gradient projections: one factorisation for all faces (mprgp.hpp)
};
inline constexpr std::array all_solvers{Solver::active_set, Solver::projected, Solver::tao, Solver::snesvi,
                                        Solver::mprgp};
/// Returns the name in case files: "active-set", "projected", "tao", "snesvi", "mprgp".
std::string_view to_string(Solver solver);

/// Whether a subproblem near the factorised one is solved with the available factor.
enum class KeptFactor { where_cheaper, always };

struct Settings {
  Solver solver = Solver::active_set;
  int max_iterations = 200;  ///< active-set changes on one mesh; each costs one factorisation (except with mprgp)
  double gap_tolerance =
      1e-11;  ///< a bound counts as violated beyond this multiple of the largest unknown with a bound
  double multiplier_tolerance = 1e-10;  ///< a multiplier counts as negative beyond this multiple of the largest one
  double linear_tolerance = 1e-12;      ///< relative residual, in the preconditioner's norm, of the linear solves
  /// Look for motions whose stiffness is only rounding, at the cost of two solves in each step. It is unnecessary once
  /// the bounds that never move are known to fix the structure.
  bool detect_free_motions = true;
  KeptFactor kept_factor = KeptFactor::where_cheaper;
  int max_refinement_steps = 30;   ///< conjugate-gradient steps of one linear solve with an exact preconditioner
  int max_iterative_steps = 2000;  ///< the same with an inexact preconditioner, and for one face of mprgp
};

}  // namespace plastron::contact

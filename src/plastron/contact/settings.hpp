// Settings of the contact solvers, and the type of these functions.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>

#include <span>

namespace plastron::contact {

struct Settings;

/// A contact solver: minimises 1/2 z' A z - b' z over the box and over the positions of pressing forces, with B z = 0
/// where there are equations. `initial` is the starting active set (owned unknowns; empty: nothing active),
/// `preconditioner` belongs to problem.matrix. The result has the status. Throws std::invalid_argument for an initial
/// set of a wrong size. (collective)
using SolverFunction = BoxSolution(const BoxProblem& problem, std::span<const Activity> initial,
                                   algebra::Preconditioner& preconditioner, const Settings& settings,
                                   const Observer& observer);

/// Whether a subproblem near the factorised one is solved with the available factor.
enum class KeptFactor { where_cheaper, always };

struct Settings {
  SolverFunction* solver = nullptr;  ///< the solver that solve() calls; null: solve_primal_dual_active_set (solve.hpp)
  int max_iterations = 200;          ///< active-set changes on one mesh; each costs one factorisation
  double gap_tolerance =
      1e-11;  ///< a bound counts as violated beyond this multiple of the largest unknown with a bound
  double multiplier_tolerance = 1e-10;  ///< a multiplier counts as negative beyond this multiple of the largest one
  double linear_tolerance = 1e-12;      ///< relative residual, in the preconditioner's norm, of the linear solves
  /// Look for motions whose stiffness is only rounding, at the cost of two solves in each step. It is unnecessary once
  /// the bounds that never move are known to fix the structure.
  bool detect_free_motions = true;
  KeptFactor kept_factor = KeptFactor::where_cheaper;
  int max_refinement_steps = 30;  ///< conjugate-gradient steps of one linear solve
};

}  // namespace plastron::contact

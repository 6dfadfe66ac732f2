// PETSc's Newton methods for a quadratic function on a box,
//   minimise 1/2 x' A x - b' x   subject to   lower <= x <= upper,
// with A as an operator and the caller's solver for the linear systems on faces. We do only the parts that PETSc cannot
// know, so that these methods are independent checks of our own contact solvers. Both use the norm of x without
// scaling: scale A to a unit diagonal before.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/vector.hpp>

#include <functional>
#include <span>

namespace plastron::algebra {

struct BoundedQuadratic {
  Operator apply;  ///< y = A x
  Vector load;     ///< b
  Vector lower, upper;
  /// Computes s with (A s - r)_i = 0 where held[i] == 0 and s_i = 0 elsewhere; r is zero there. Returns false if there
  /// is no such s. (collective)
  std::function<bool(std::span<const char> held, const Vector& r, Vector& s)> solve_on_face;
};

struct BoundedNewtonSettings {
  int max_iterations = 200;
  /// Tolerance of the residual |x - P(x - (A x - b))|, P the projection on the box. It is not less than the rounding,
  /// 64 eps |x|.
  double tolerance = 1e-8;
  /// Receives every iterate (`iteration` counts from 0, the start) with its gradient A x - b; false stops. Must return
  /// the same on all ranks.
  std::function<bool(int iteration, const Vector& x, const Vector& gradient)> go_on{};
};

enum class BoundedNewtonEnd {
  converged,
  iteration_limit,
  stopped,           ///< go_on returned false
  no_face_solution,  ///< a linear system had no solution
  failed             ///< failure of the line search or of another part of PETSc
};

/// TAOBNLS: Newton steps on the inactive unknowns of Bertsekas's estimate, with a projected line search on the energy
/// (More and Thuente). It is TAO's bounded Newton method without a trust region. A trust region would shorten steps
/// without benefit for a convex quadratic function. Improves x, which need not be in the box. Throws the exceptions of
/// the functions above. (collective)
BoundedNewtonEnd minimise_with_tao(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings, Vector& x);

/// SNESVINEWTONRSLS: Newton steps for A x - b = 0 on the inactive unknowns, projected on the box, with a line search on
/// the norm of the inactive residual. Source: Benson and Munson, Flexible complementarity solvers for large-scale
/// applications (2006). It has no proof of convergence: it stops where the norm does not decrease. (collective)
BoundedNewtonEnd solve_with_snesvi(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings, Vector& x);

}  // namespace plastron::algebra

// PETSc's Newton methods for a quadratic function on a box,
//   minimise 1/2 x' A x - b' x   subject to   lower <= x <= upper,
// with A as an operator and the caller's solver for the linear systems on faces. What is ours is kept to what PETSc cannot know, so that
// these are referees of our own contact solvers. Both work in the norm of x as it is: scale A to a unit diagonal before.
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
  /// s with (A s - r)_i = 0 where held[i] == 0 and s_i = 0 elsewhere; r is zero there. False if that cannot be had. (collective)
  std::function<bool(std::span<const char> held, const Vector& r, Vector& s)> solve_on_face;
};

struct BoundedNewtonSettings {
  int max_iterations = 200;
  /// Of the residual |x - P(x - (A x - b))|, P the projection on the box; not less than rounding leaves, 64 eps |x|.
  double tolerance = 1e-8;
  /// Sees every iterate (`iteration` counts from 0, the start) with its gradient A x - b; false stops. Must answer alike on all ranks.
  std::function<bool(int iteration, const Vector& x, const Vector& gradient)> go_on{};
};

enum class BoundedNewtonEnd {
  converged,
  iteration_limit,
  stopped,           ///< go_on said so
  no_face_solution,  ///< a linear system had none
  failed             ///< the line search, or anything else in PETSc
};

/// TAOBNLS: Newton steps on the inactive unknowns of Bertsekas's estimate, with a projected line search on the energy (More and Thuente).
/// Of TAO's bounded Newton methods the one without a trust region, which for a convex quadratic function shortens steps for
/// nothing. Improves x, which need not lie in the box. What is thrown in the functions above is thrown here. (collective)
BoundedNewtonEnd minimise_with_tao(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings, Vector& x);

/// SNESVINEWTONRSLS: Newton steps for A x - b = 0 on the inactive unknowns, projected on the box, with a line search on the norm of
/// the inactive residual. Source: Benson and Munson, Flexible complementarity solvers for large-scale applications (2006). It
/// has no proof of convergence: where the norm does not fall it gives up. (collective)
BoundedNewtonEnd solve_with_snesvi(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings, Vector& x);

}  // namespace plastron::algebra

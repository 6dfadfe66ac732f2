// TAOBNLS, the bounded Newton method of PETSc's TAO, for a quadratic function on a box,
//   minimise 1/2 x' A x - b' x   subject to   lower <= x <= upper,
// with A as an operator and the caller's solver for the linear systems on faces. We do only the parts that PETSc cannot
// know, so that this method is an independent check of our own contact solvers. It uses the norm of x without scaling:
// scale A to a unit diagonal before.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/vector.hpp>

#include <functional>
#include <span>

namespace plastron::referees {

struct BoundedQuadratic {
  algebra::Operator apply;  ///< y = A x
  algebra::Vector load;     ///< b
  algebra::Vector lower, upper;
  /// Computes s with (A s - r)_i = 0 where fixed[i] == 0 and s_i = 0 elsewhere; r is zero there. Returns false if there
  /// is no such s. (collective)
  std::function<bool(std::span<const char> fixed, const algebra::Vector& r, algebra::Vector& s)> solve_on_face;
};

struct BoundedNewtonSettings {
  int max_iterations = 200;
  /// Tolerance of the residual |x - P(x - (A x - b))|, P the projection on the box. It is not less than the rounding,
  /// 64 eps |x|.
  double tolerance = 1e-8;
  /// Receives every iterate (`iteration` counts from 0, the start) with its gradient A x - b; false stops. Must return
  /// the same on all ranks.
  std::function<bool(int iteration, const algebra::Vector& x, const algebra::Vector& gradient)> go_on{};
};

enum class BoundedNewtonEnd {
  converged,
  iteration_limit,
  stopped,           ///< go_on returned false
  no_face_solution,  ///< a linear system had no solution
  failed             ///< failure of the line search or of another part of PETSc
};

/// Newton steps on the inactive unknowns of Bertsekas's estimate, with a projected line search on the energy
/// (More and Thuente). It is TAO's bounded Newton method without a trust region. A trust region would shorten steps
/// without benefit for a convex quadratic function. Improves x, which need not be in the box. Throws the exceptions of
/// the functions above. (collective)
BoundedNewtonEnd minimise_with_tao(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings,
                                   algebra::Vector& x);

}  // namespace plastron::referees

// Conjugate gradients for A x = b, where A is known more exactly as an operator than as the factorised matrix.
// The factor serves as preconditioner, so one to five steps are usual. Each step recomputes the residual b - A x from x
// (iterative refinement with conjugate directions). Hence the accuracy is given by the operator, not by the matrix.
// Source of the flexible direction update: Golub and Ye, Inexact preconditioned conjugate gradient method (1999).
#pragma once
#include <plastron/algebra/vector.hpp>

#include <functional>
#include <span>

namespace plastron::algebra {

/// Computes y = A x for owned values (collective). The ghosts of x are current.
using Operator = std::function<void(const Vector& x, Vector& y)>;

struct CgSettings {
  /// Tolerance of the residual in the preconditioner's norm, relative to the residual of x = 0 (see below).
  double tolerance = 1e-12;
  int max_steps = 30;
  int patience = 2;  ///< ends when this number of steps together does not halve the residual
};

struct CgResult {
  int steps = 0;
  /// sqrt(r' M^{-1} r), nearly the energy norm of the error, divided by its value when all unknowns except the fixed
  /// ones are 0.
  double relative_residual = 0;
  /// Whether the tolerance is met, or the residual is as small as rounding of x to double precision permits.
  bool converged = false;
  /// b - A x of the returned x, including the equations of fixed unknowns.
  Vector residual{};
};

/// Improves x. Unknowns with fixed[i] != 0 (owned; empty: none) keep their values, and their equations are ignored.
/// `precondition` must map a residual that is zero there to a correction that is zero there. `diagonal` of A (may be
/// empty) gives the rounding limit sqrt(sum_i A_ii (eps x_i)^2), which no iterate can go below. The iteration also ends
/// when `patience` steps together do not halve the residual. It returns the best iterate, with current ghosts.
/// (collective)
CgResult conjugate_gradients(const Operator& apply, const Operator& precondition, const Vector& b,
                             std::span<const char> fixed, const Vector& diagonal, Vector& x,
                             const CgSettings& settings = {});

}  // namespace plastron::algebra

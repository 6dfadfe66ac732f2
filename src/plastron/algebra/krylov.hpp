// Conjugate gradients for A x = b where A is known better as an operator than as the matrix that was factorised.
// The factor serves as preconditioner, so one to five steps are usual; each one recomputes the residual b - A x from x
// itself (iterative refinement with conjugate directions), hence the accuracy is the operator's, not the matrix's.
// Source of the flexible direction update: Golub and Ye, Inexact preconditioned conjugate gradient method (1999).
#pragma once
#include <plastron/algebra/vector.hpp>

#include <functional>
#include <span>

namespace plastron::algebra {

/// y = A x for owned values (collective); x comes with ghosts up to date.
using Operator = std::function<void(const Vector& x, Vector& y)>;

struct CgSettings {
  double tolerance = 1e-12;  ///< of the residual in the preconditioner's norm, relative to that of x = 0 (see below)
  int max_steps = 30;
  int patience = 2;  ///< ends when so many steps together do not halve the residual
};

struct CgResult {
  int steps = 0;
  /// sqrt(r' M^{-1} r), about the energy norm of the error, divided by its value when all unknowns but the fixed are 0.
  double relative_residual = 0;
  /// The tolerance is met, or the residual is as small as x rounded to double precision permits.
  bool converged = false;
  /// b - A x of the x that is returned, the equations of fixed unknowns included.
  Vector residual{};
};

/// Improves x. Unknowns with fixed[i] != 0 (owned; empty: none) keep their values, and their equations are left out;
/// `precondition` must map a residual that is zero there to a correction that is zero there. `diagonal` of A (may be
/// empty) gives the rounding floor sqrt(sum_i A_ii (eps x_i)^2), below which no iterate can get. Ends also when
/// `patience` steps together do not halve the residual, and returns the best iterate, ghosts up to date. (collective)
CgResult conjugate_gradients(const Operator& apply, const Operator& precondition, const Vector& b,
                             std::span<const char> fixed, const Vector& diagonal, Vector& x,
                             const CgSettings& settings = {});

}  // namespace plastron::algebra

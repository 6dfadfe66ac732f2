// A few eigenvalues at one end of the spectrum, by the Krylov-Schur method of SLEPc:
//   T x = theta x        for T given as an operator and self-adjoint in the inner product (x, y) = x' B y,
//   A x = theta B x      for symmetric matrices, the smallest theta; T = (A + sigma B)^{-1} B = 1 / (theta + sigma).
// Source: Stewart, A Krylov-Schur algorithm for large eigenproblems (2001); Hernandez, Roman, Vidal, SLEPc (2005).
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/matrix.hpp>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace plastron::algebra {

enum class End { smallest, largest };

struct EigenSettings {
  int count = 1;            ///< number of eigenvalues, from the end of the spectrum inwards
  double tolerance = 1e-9;  ///< |T x - theta x| <= tolerance |theta| in the norm of B
  int max_restarts = 300;
  /// Asked before each application of T. All ranks stop together: it gives the same on all of them.
  std::function<bool()> stop{};
};

struct Eigenpairs {
  bool converged = false;         ///< whether all converged
  bool was_stopped = false;       ///< by EigenSettings::stop; then there are no values
  std::vector<double> values{};   ///< theta, from the end inwards
  std::vector<Vector> vectors{};  ///< x' B x = 1, zero where fixed, with valid ghosts
  int applications = 0;           ///< number of applications of T
};

/// T and B on the unknowns that are not fixed. B is positive definite there; B T symmetric.
struct SelfAdjointOperator {
  std::shared_ptr<const Layout> layout{};
  int block = 1;
  Operator apply{};               ///< T; its values at fixed unknowns are ignored
  Operator inner_product{};       ///< B
  std::span<const char> fixed{};  ///< marks of the owned unknowns; marked ones are zero
};

/// Computes eigenpairs; all copies of multiple eigenvalues are found. `count` beyond the number of free unknowns gives
/// all eigenvalues. (collective)
Eigenpairs eigenpairs(const SelfAdjointOperator& T, End end, const EigenSettings& settings = {});

/// Computes the smallest theta, ascending. A + shift B must be positive definite on the free unknowns; it is
/// factorised. A and B have the same pattern. Not converged, and empty, if a pivot is not positive. (collective)
Eigenpairs smallest_eigenpairs(const Matrix& A, const Matrix& B, std::span<const char> fixed, double shift,
                               const EigenSettings& settings = {});

}  // namespace plastron::algebra

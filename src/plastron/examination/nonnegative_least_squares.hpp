// Least squares with non-negative coefficients, for few rows: min |b - A x| over x >= 0.
// C. L. Lawson, R. J. Hanson: Solving least squares problems, chapter 23.
#pragma once
#include <Eigen/Core>

namespace plastron::examination {

/// Returns the residual b - A x of the best x >= 0. By Farkas' lemma it is zero, or a direction r with A' r <= 0 and
/// b . r > 0.
Eigen::VectorXd nonnegative_residual(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace plastron::examination

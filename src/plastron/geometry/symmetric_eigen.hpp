// Eigenvalues and eigenvectors of symmetric matrices. Eigen's solver is instantiated only here: each use would take
// seconds to compile.
#pragma once
#include <Eigen/Core>

namespace plastron::geometry {

/// A = V diag(values) V'; values ascend, and column k of V, a unit vector, belongs to value k.
template <class Matrix>
struct SymmetricEigen {
  Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1> values;
  Matrix vectors;
};

/// Uses the lower triangle. Closed form.
SymmetricEigen<Eigen::Matrix2d> symmetric_eigen(const Eigen::Matrix2d& A);
/// Uses the lower triangle. Tridiagonal form and QR steps.
SymmetricEigen<Eigen::Matrix3d> symmetric_eigen(const Eigen::Matrix3d& A);
SymmetricEigen<Eigen::MatrixXd> symmetric_eigen(const Eigen::MatrixXd& A);

}  // namespace plastron::geometry

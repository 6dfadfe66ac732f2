// Eigenvalues and eigenvectors of symmetric matrices. Eigen's solver, in one place: each use of it would cost the compiler seconds.
#pragma once
#include <Eigen/Core>

namespace plastron::geometry {

/// A = V diag(values) V'; values ascend, and column k of V, a unit vector, belongs to value k.
template <class Matrix>
struct SymmetricEigen {
  Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1> values;
  Matrix vectors;
};

/// The lower triangle counts. Closed form.
SymmetricEigen<Eigen::Matrix2d> symmetric_eigen(const Eigen::Matrix2d& A);
/// The lower triangle counts. Tridiagonal form and QR steps.
SymmetricEigen<Eigen::Matrix3d> symmetric_eigen(const Eigen::Matrix3d& A);
SymmetricEigen<Eigen::MatrixXd> symmetric_eigen(const Eigen::MatrixXd& A);

}  // namespace plastron::geometry

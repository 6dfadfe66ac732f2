#include <plastron/geometry/symmetric_eigen.hpp>

#include <Eigen/Eigenvalues>

namespace plastron::geometry {

SymmetricEigen<Eigen::Matrix2d> symmetric_eigen(const Eigen::Matrix2d& A) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen<Eigen::Matrix3d> symmetric_eigen(const Eigen::Matrix3d& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen<Eigen::MatrixXd> symmetric_eigen(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace plastron::geometry

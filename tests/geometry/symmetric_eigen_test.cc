// Eigenvalues of symmetric matrices of all sizes in use: A V = V diag(values), V'V = 1, values ascending.
#include <gtest/gtest.h>
#include <plastron/geometry/symmetric_eigen.hpp>

#include <Eigen/Core>

#include <cmath>

namespace plastron::geometry {
namespace {

template <class Matrix>
Matrix symmetric(Eigen::Index n) {
  Matrix A(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) A(i, j) = A(j, i) = std::sin(3.0 * static_cast<double>(i * n + j) + 1);
  return A;
}

template <class Matrix>
void expect_pairs_of(const Matrix& A) {
  const auto eigen = symmetric_eigen(A);
  const double size = A.norm();
  EXPECT_LE((A * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-14 * size);
  EXPECT_LE((eigen.vectors.transpose() * eigen.vectors - Matrix::Identity(A.rows(), A.rows())).norm(), 1e-14);
  for (Eigen::Index k = 1; k < A.rows(); ++k) EXPECT_LE(eigen.values[k - 1], eigen.values[k]);
}

TEST(SymmetricEigen, has_pairs_of_matrices_of_two_three_and_more_rows) {
  expect_pairs_of(symmetric<Eigen::Matrix2d>(2));
  expect_pairs_of(symmetric<Eigen::Matrix3d>(3));
  expect_pairs_of(symmetric<Eigen::MatrixXd>(7));
}

TEST(SymmetricEigen, has_pairs_where_values_are_equal_or_of_unlike_size) {
  expect_pairs_of(Eigen::Matrix2d(Eigen::Matrix2d::Identity()));
  expect_pairs_of(Eigen::Matrix2d(Eigen::Matrix2d::Zero()));
  expect_pairs_of(Eigen::Matrix2d{{1e12, 1e-3}, {1e-3, 1e-6}});
  expect_pairs_of(Eigen::Matrix2d{{1e-30, 2e-31}, {2e-31, -3e-30}});
}

}  // namespace
}  // namespace plastron::geometry

// Against brute force over all sets of columns, and the optimality conditions.
#include <plastron/examination/rigid_motions.hpp>

#include <gtest/gtest.h>
#include <Eigen/QR>

#include <random>
#include <vector>

namespace plastron::examination {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

MatrixXd random_matrix(int rows, int columns, std::mt19937& random) {
  std::normal_distribution<double> normal;
  MatrixXd m(rows, columns);
  for (double& entry : m.reshaped()) entry = normal(random);
  return m;
}

/// Least |b - A x| over every set of columns whose best coefficients are non-negative.
double brute_force(const MatrixXd& A, const VectorXd& b) {
  double least = b.norm();
  for (int set = 1; set < 1 << A.cols(); ++set) {
    std::vector<Eigen::Index> columns;
    for (int k = 0; k < A.cols(); ++k)
      if (set >> k & 1) columns.push_back(k);
    const MatrixXd taken = A(Eigen::all, columns);
    const VectorXd x = taken.completeOrthogonalDecomposition().solve(b);
    if (x.minCoeff() >= 0) least = std::min(least, (b - taken * x).norm());
  }
  return least;
}

TEST(NonnegativeLeastSquares, agree_with_the_best_of_all_sets_of_columns) {
  std::mt19937 random(7);
  for (int sample = 0; sample < 200; ++sample) {
    const int rows = 1 + sample % 6, columns = 1 + sample % 9;
    const MatrixXd A = random_matrix(rows, columns, random);
    const VectorXd b = random_matrix(rows, 1, random);
    EXPECT_NEAR(nonnegative_residual(A, b).norm(), brute_force(A, b), 1e-10 * b.norm()) << sample;
  }
}

TEST(NonnegativeLeastSquares, leave_a_residual_that_no_column_can_lower) {
  std::mt19937 random(8);
  for (int sample = 0; sample < 50; ++sample) {
    const MatrixXd A = random_matrix(6, 300, random).cwiseAbs();
    const VectorXd b = random_matrix(6, 1, random);
    const VectorXd r = nonnegative_residual(A, b);
    EXPECT_LE((A.transpose() * r).maxCoeff(), 1e-9 * b.norm());
    EXPECT_NEAR(b.dot(r), r.squaredNorm(), 1e-9 * b.squaredNorm());
  }
}

TEST(NonnegativeLeastSquares, find_a_combination_where_there_is_one_though_columns_repeat) {
  std::mt19937 random(9);
  for (int sample = 0; sample < 50; ++sample) {
    MatrixXd A = random_matrix(3, 400, random);
    A.row(0).setOnes();
    A.row(1) = A.row(1).array().sign();  // all at two lines
    A.rightCols(200) = A.leftCols(200);
    const VectorXd b = A * random_matrix(400, 1, random).cwiseAbs();
    EXPECT_LT(nonnegative_residual(A, b).norm(), 1e-10 * b.norm());
  }
}

TEST(NonnegativeLeastSquares, without_columns_leave_everything) {
  EXPECT_EQ(nonnegative_residual(MatrixXd(2, 0), VectorXd::Ones(2)), VectorXd::Ones(2));
}

}  // namespace
}  // namespace plastron::examination

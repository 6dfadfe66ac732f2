// Eigenvalues against Eigen's dense solver, on any number of ranks.
#include <plastron/algebra/eigenvalues.hpp>
#include <plastron/algebra/factorisation.hpp>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <cmath>

#include "algebra/beam.hpp"

namespace plastron::test {
namespace {

using algebra::Eigenpairs;
using algebra::End;
using algebra::Operator;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A chain of nodes with two unknowns each, with different springs between neighbours and to the ground.
struct Chain {
  explicit Chain(GlobalIndex nodes, double to_ground, double variation)
      : elements(chain(nodes)),
        layout(layout_for(nodes, elements)),
        own(connectivity(*layout, elements)),
        matrix(layout, 2, own) {
    for (std::size_t k = 0; k < own.elements(); ++k) {
      const auto first = static_cast<double>(layout->global(own.element(k)[0]));
      Eigen::Matrix4d K;
      K << 1, 0, -1, 0, 0, 2, 0, -2, -1, 0, 1, 0, 0, -2, 0, 2;
      K *= 1 + variation * std::sin(first);
      K.diagonal().array() += to_ground;
      K(0, 1) += to_ground / 3;
      K(1, 0) += to_ground / 3;
      matrix.add(own.element(k), {K.data(), 16});
    }
    matrix.finish();
  }

  MatrixXd dense() const {
    const auto n = static_cast<Eigen::Index>(layout->global_size * 2);
    MatrixXd D(n, n);
    Vector y(layout, 2);
    for (Eigen::Index j = 0; j < n; ++j) {
      matrix.multiply(vector_of(layout, 2, [&](GlobalIndex i) { return i == j ? 1.0 : 0.0; }), y);
      D.col(j) = Eigen::Map<const VectorXd>(gather(y).data(), n);
    }
    return D;
  }

  Elements elements;
  std::shared_ptr<const Layout> layout;
  Connectivity own;
  Matrix matrix;
};

/// Global unknowns 0, 1 and 7.
bool is_fixed(GlobalIndex i) { return i < 2 || i == 7; }

std::vector<char> fixed_marks(const Layout& layout) {
  std::vector<char> fixed;
  for (GlobalIndex i = 2 * layout.first; i < 2 * (layout.first + layout.owned); ++i) fixed.push_back(is_fixed(i));
  return fixed;
}

VectorXd dense_eigenvalues(const MatrixXd& A, const MatrixXd& B) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    if (!is_fixed(i)) free.push_back(i);
  const MatrixXd Af = A(free, free), Bf = B(free, free);
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(Af, Bf).eigenvalues();
}

/// A x = theta B x on the free unknowns, x' B x = 1, x = 0 where fixed.
void expect_definition(const Matrix& A, const Matrix& B, const std::vector<char>& fixed, const Eigenpairs& pairs) {
  for (std::size_t k = 0; k < pairs.values.size(); ++k) {
    Vector Ax(A.layout(), A.block()), Bx(A.layout(), A.block());
    A.multiply(pairs.vectors[k], Ax);
    B.multiply(pairs.vectors[k], Bx);
    EXPECT_NEAR(algebra::dot(pairs.vectors[k], Bx), 1, 1e-10);
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      if (fixed[i]) {
        EXPECT_EQ(pairs.vectors[k].owned()[i], 0);
      } else {
        EXPECT_NEAR(Ax.owned()[i], pairs.values[k] * Bx.owned()[i], 1e-6);
      }
    }
  }
}

TEST(Eigenvalues, are_those_of_a_dense_solver) {
  const Chain A(40, 0.01, 0.5), B(40, 1.0, 0.1);
  const auto fixed = fixed_marks(*A.layout);
  const VectorXd expected = dense_eigenvalues(A.dense(), B.dense());
  for (const double shift : {0.0, 0.3}) {
    const Eigenpairs pairs = algebra::smallest_eigenpairs(A.matrix, B.matrix, fixed, shift, {.count = 5});
    ASSERT_TRUE(pairs.converged);
    ASSERT_EQ(pairs.values.size(), 5u);
    for (Eigen::Index k = 0; k < 5; ++k)
      EXPECT_NEAR(pairs.values[static_cast<std::size_t>(k)], expected[k], 1e-9 * (1 + shift / expected[k]));
    expect_definition(A.matrix, B.matrix, fixed, pairs);
  }
}

TEST(Eigenvalues, of_an_operator_are_found_at_both_ends) {
  const Chain A(40, 0.01, 0.5), B(40, 1.0, 0.1);
  const auto fixed = fixed_marks(*A.layout);
  const VectorXd expected = dense_eigenvalues(A.dense(), B.dense());
  algebra::Factorisation F(B.matrix);
  ASSERT_TRUE(F.factorise(fixed));
  Vector Ax(A.layout, 2);
  const algebra::SelfAdjointOperator T{A.layout, 2,
                                       [&](const Vector& x, Vector& y) {
                                         A.matrix.multiply(x, Ax);
                                         F.solve(Ax, y);
                                       },
                                       [&](const Vector& x, Vector& y) { B.matrix.multiply(x, y); }, fixed};
  const auto low = algebra::eigenpairs(T, End::smallest, {.count = 3});
  const auto high = algebra::eigenpairs(T, End::largest, {.count = 3});
  ASSERT_TRUE(low.converged && high.converged);
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(low.values[static_cast<std::size_t>(k)], expected[k], 1e-9);
    EXPECT_NEAR(high.values[static_cast<std::size_t>(k)], expected[expected.size() - 1 - k], 1e-9);
  }
}

// Diagonal matrices: every eigenvalue occurs many times, but a Krylov space from one vector contains it only once.
TEST(Eigenvalues, that_are_multiple_are_all_found) {
  const GlobalIndex nodes = 30;
  const auto layout = layout_for(nodes, chain(nodes));
  const Operator diagonal = [&](const Vector& x, Vector& y) {
    for (std::size_t i = 0; i < x.owned().size(); ++i)
      y.owned()[i] = (layout->first + static_cast<GlobalIndex>(i)) % 5 == 0 ? x.owned()[i] : 3 * x.owned()[i];
  };
  const Operator identity = [](const Vector& x, Vector& y) { std::ranges::copy(x.owned(), y.owned().begin()); };
  const auto pairs = algebra::eigenpairs({layout, 1, diagonal, identity, {}}, End::smallest, {.count = 8});
  ASSERT_TRUE(pairs.converged);
  ASSERT_EQ(pairs.values.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(pairs.values[k], k < 6 ? 1 : 3, 1e-9);
}

TEST(Eigenvalues, are_as_many_as_there_are_free_unknowns_at_most) {
  const Chain A(3, 0.1, 0.5), B(3, 1.0, 0.1);
  const auto pairs = algebra::smallest_eigenpairs(A.matrix, B.matrix, fixed_marks(*A.layout), 0, {.count = 50});
  EXPECT_TRUE(pairs.converged);
  EXPECT_EQ(pairs.values.size(), 4u);
}

TEST(Eigenvalues, are_not_there_when_the_shifted_matrix_is_indefinite) {
  const Chain A(10, 0.1, 0.5), B(10, 1.0, 0.1);
  const auto pairs = algebra::smallest_eigenpairs(A.matrix, B.matrix, fixed_marks(*A.layout), -100, {});
  EXPECT_FALSE(pairs.converged);
  EXPECT_TRUE(pairs.values.empty());
}

TEST(Eigenvalues, are_not_there_when_the_search_is_stopped) {
  const Chain A(40, 0.1, 0.5), B(40, 1.0, 0.1);
  int asked = 0;
  for (const int last : {1, 5}) {
    const auto pairs = algebra::smallest_eigenpairs(A.matrix, B.matrix, fixed_marks(*A.layout), 0,
                                                    {.count = 4, .stop = [&, left = last]() mutable {
                                                       ++asked;
                                                       return left-- == 0;
                                                     }});
    EXPECT_TRUE(pairs.was_stopped);
    EXPECT_FALSE(pairs.converged);
    EXPECT_TRUE(pairs.values.empty());
  }
  EXPECT_EQ(asked, 2 + 6);
  EXPECT_TRUE(algebra::smallest_eigenpairs(A.matrix, B.matrix, fixed_marks(*A.layout), 0,
                                           {.count = 4, .stop = [] { return false; }})
                  .converged);
}

// An exception of the operator reaches the caller, and SLEPc still works afterwards.
TEST(Eigenvalues, pass_on_what_the_operator_throws) {
  const auto layout = layout_for(10, chain(10));
  const Operator identity = [](const Vector& x, Vector& y) { std::ranges::copy(x.owned(), y.owned().begin()); };
  const Operator broken = [](const Vector&, Vector&) { throw std::domain_error("no value here"); };
  EXPECT_THROW(algebra::eigenpairs({layout, 1, broken, identity, {}}, End::largest), std::domain_error);
  EXPECT_TRUE(algebra::eigenpairs({layout, 1, identity, identity, {}}, End::largest).converged);
}

}  // namespace
}  // namespace plastron::test

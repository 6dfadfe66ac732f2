// A preconditioner without a factor, for small problems: the diagonal. It shows that the contact solvers need no factorisation.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/algebra/preconditioner.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "algebra/chain.hpp"

namespace plastron::test {

class Jacobi : public algebra::Preconditioner {
 public:
  explicit Jacobi(const Matrix& A) : A_(A), diagonal_(A.diagonal()) {}

  algebra::Pinning pin(std::span<const char> pinned, double shift) override {
    shift_ = shift;
    ++pinnings;
    double worst = 1;
    for (std::size_t i = 0; i < pinned.size(); ++i)
      if (!pinned[i]) worst = std::min(worst, diagonal_.owned()[i]);
    const bool positive = algebra::min_over_ranks(worst, A_.layout()->comm) > 0;
    return positive ? algebra::Pinning::done : algebra::Pinning::not_positive_definite;
  }
  void apply(const Vector& r, Vector& z) const override {
    for (std::size_t i = 0; i < r.owned().size(); ++i)
      z.owned()[i] = r.owned()[i] / ((1 + shift_) * diagonal_.owned()[i]);
  }
  bool is_exact() const override { return false; }
  algebra::Price price() const override { return {.pin = 1, .apply = 1}; }

  /// All eigenvectors of A v = theta D v on what is not pinned, by dense algebra.
  algebra::SoftestMotion softest_motion(const algebra::Operator& operate, std::span<const char> pinned,
                                        const Vector& diagonal) const override {
    Vector free(diagonal);
    for (std::size_t i = 0; i < pinned.size(); ++i) free.owned()[i] = pinned[i] ? 0 : 1;
    const Eigen::VectorXd is_free = gathered_here(free), d = gathered_here(diagonal);
    std::vector<Eigen::Index> unknowns;
    for (Eigen::Index i = 0; i < is_free.size(); ++i)
      if (is_free(i) > 0) unknowns.push_back(i);
    algebra::SoftestMotion softest{Vector(diagonal.layout(), diagonal.block())};
    if (unknowns.empty()) return softest;
    const Eigen::MatrixXd dense = dense_of(operate, diagonal)(unknowns, unknowns);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> pairs(dense,
                                                                          d(unknowns).asDiagonal().toDenseMatrix());
    Eigen::VectorXd v = Eigen::VectorXd::Zero(d.size());
    v(unknowns) = pairs.eigenvectors().col(0);
    for (std::size_t i = 0; i < pinned.size(); ++i)
      softest.motion.owned()[i] = v(first(diagonal) + static_cast<Eigen::Index>(i));
    softest.motion.update_ghosts();
    Vector force(softest.motion);
    operate(softest.motion, force);
    softest.stiffness = algebra::dot(softest.motion, force);
    A_.multiply(softest.motion, force);
    softest.factor_stiffness = algebra::dot(softest.motion, force);
    return softest;
  }

  int pinnings = 0;

 private:
  static Eigen::Index first(const Vector& v) { return static_cast<Eigen::Index>(v.layout()->first * v.block()); }
  static Eigen::VectorXd gathered_here(const Vector& v) {
    const auto values = gather(v);
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }
  static Eigen::MatrixXd dense_of(const algebra::Operator& operate, const Vector& like) {
    const auto n = static_cast<Eigen::Index>(like.layout()->global_size * like.block());
    Eigen::MatrixXd dense(n, n);
    Vector y(like);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Vector unit = vector_of(like.layout(), like.block(), [j](GlobalIndex i) { return i == j ? 1.0 : 0.0; });
      operate(unit, y);
      dense.col(j) = gathered_here(y);
    }
    return 0.5 * (dense + dense.transpose());
  }

  const Matrix& A_;
  Vector diagonal_;
  double shift_ = 0;
};

}  // namespace plastron::test

// Small box-constrained problems with dense matrices, known on every rank and solved distributed; and the exact
// solution by trying every active set.
#pragma once
#include <plastron/algebra/factorisation.hpp>
#include <plastron/contact/solve.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "algebra/chain.hpp"

namespace plastron::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct DenseProblem {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  Eigen::Index size() const { return b.size(); }
};

inline Matrix distribute(const Eigen::MatrixXd& A) {
  const auto n = static_cast<GlobalIndex>(A.rows());
  const Elements elements = all_pairs(n);
  const auto layout = layout_for(n, elements);
  Matrix matrix(layout, 1, connectivity(*layout, elements));
  for (LocalIndex i = 0; i < layout->owned; ++i)
    matrix.add(std::vector<LocalIndex>{i}, std::vector<double>{A(layout->global(i), layout->global(i))});
  for (const auto& pair : elements)
    if (layout->owns(pair[0]))
      matrix.add(local_nodes(*layout, pair), std::vector<double>{0, A(pair[0], pair[1]), A(pair[0], pair[1]), 0});
  matrix.finish();
  return matrix;
}

/// A BoxProblem and the objects that it refers to.
struct DistributedProblem {
  explicit DistributedProblem(const DenseProblem& dense) : matrix(distribute(dense.A)) {
    const auto part = [&](const Eigen::VectorXd& v) {
      return vector_of(matrix.layout(), 1, [&](GlobalIndex i) { return v(i); });
    };
    box.emplace(contact::BoxProblem{.matrix = matrix,
                                    .apply = [this](const Vector& z, Vector& y) { matrix.multiply(z, y); },
                                    .load = part(dense.b),
                                    .lower = part(dense.lower),
                                    .upper = part(dense.upper)});
  }
  DistributedProblem(const DistributedProblem&) = delete;
  DistributedProblem& operator=(const DistributedProblem&) = delete;

  Matrix matrix;
  std::optional<contact::BoxProblem> box{};
};

struct NamedSolver {
  std::string name;
  contact::SolverFunction* solve;
};

/// The solvers that the tests EverySolver examine. Each program that contains these tests defines its own:
/// the library's (solve_test.cc) or the referees (research/referees_test.cc).
std::vector<NamedSolver> solvers();

inline contact::BoxSolution solve_with(const NamedSolver& solver, const contact::BoxProblem& problem,
                                       algebra::Preconditioner& preconditioner,
                                       std::span<const contact::Activity> initial = {},
                                       const contact::Settings& settings = {}, const contact::Observer& observer = {}) {
  return solver.solve(problem, initial, preconditioner, settings, observer);
}

inline Eigen::VectorXd gathered(const Vector& v) {
  const auto values = gather(v);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// z on the subproblem where unknown i is free (side[i] = 0), at its lower (1) or upper bound (2); NaN if a motion is free there.
inline Eigen::VectorXd minimise_on_face(const DenseProblem& problem, const std::vector<int>& side) {
  Eigen::VectorXd held = Eigen::VectorXd::Zero(problem.size());
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    if (side[static_cast<std::size_t>(i)] == 1) held(i) = problem.lower(i);
    if (side[static_cast<std::size_t>(i)] == 2) held(i) = problem.upper(i);
  }
  Eigen::MatrixXd K = problem.A;
  Eigen::VectorXd right = problem.b - problem.A * held;
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    if (side[static_cast<std::size_t>(i)] == 0) continue;
    K.row(i).setZero();
    K.col(i).setZero();
    K(i, i) = 1;
    right(i) = held(i);
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(K);
  constexpr double nothing_but_rounding = 1e-13;
  if (factor.info() != Eigen::Success || factor.rcond() < nothing_but_rounding)
    return Eigen::VectorXd::Constant(problem.size(), std::nan(""));
  return factor.solve(right);
}

/// Whether z on that subproblem fulfils all conditions, up to rounding.
inline bool is_optimal(const DenseProblem& problem, const std::vector<int>& side, const Eigen::VectorXd& z) {
  if (!z.allFinite()) return false;  // the subproblem has no minimiser
  const Eigen::VectorXd multiplier = problem.A * z - problem.b;
  const double slack = 1e-9 * (1 + multiplier.cwiseAbs().maxCoeff() + z.cwiseAbs().maxCoeff());
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    if (problem.lower(i) == problem.upper(i)) continue;
    const int s = side[static_cast<std::size_t>(i)];
    if (s == 0 && (z(i) < problem.lower(i) - slack || z(i) > problem.upper(i) + slack)) return false;
    if (s == 1 && multiplier(i) < -slack) return false;
    if (s == 2 && multiplier(i) > slack) return false;
  }
  return true;
}

/// The solution by trying all 3^n subproblems. Sets that leave a motion free have no solution. Any z that passes is the only solution,
/// because A is positive semidefinite, and definite on the unknowns that the set leaves free.
inline std::optional<Eigen::VectorXd> brute_force(const DenseProblem& problem) {
  const auto n = static_cast<std::size_t>(problem.size());
  std::vector<int> side(n, 0);
  for (;;) {
    bool exists = true;
    for (std::size_t i = 0; i < n; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (side[i] == 1 && std::isinf(problem.lower(k))) exists = false;
      if (side[i] == 2 && std::isinf(problem.upper(k))) exists = false;
      if (side[i] != 1 && problem.lower(k) == problem.upper(k)) exists = false;
    }
    if (exists) {
      Eigen::VectorXd z = minimise_on_face(problem, side);
      if (is_optimal(problem, side, z)) return z;
    }
    std::size_t digit = 0;
    while (digit < n && ++side[digit] == 3) side[digit++] = 0;
    if (digit == n) return {};
  }
}

/// Symmetric positive definite; bounds of every kind.
inline DenseProblem random_problem(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> kind(0, 5);
  const auto draw = [&] { return normal(random); };
  const Eigen::MatrixXd G = Eigen::MatrixXd::NullaryExpr(n, n, draw);
  DenseProblem problem{.A = G * G.transpose() + 0.05 * Eigen::MatrixXd::Identity(n, n),
                       .b = 3 * Eigen::VectorXd::NullaryExpr(n, draw),
                       .lower = Eigen::VectorXd::Constant(n, -infinity),
                       .upper = Eigen::VectorXd::Constant(n, infinity)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const int what = kind(random);
    if (what == 1 || what == 2 || what == 4) problem.lower(i) = 0.3 * draw();
    if (what == 3) problem.upper(i) = 0.3 * draw();
    if (what == 4) problem.upper(i) = problem.lower(i) + std::abs(0.3 * draw());
    if (what == 5) problem.lower(i) = problem.upper(i) = 0.3 * draw();
  }
  return problem;
}

}  // namespace plastron::test

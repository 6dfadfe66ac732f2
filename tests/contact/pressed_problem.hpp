// Small problems in which given forces move bounds, solved distributed; and the exact solution by trying every active set with its
// border, by dense algebra.
#pragma once
#include "contact/dense_problem.hpp"

namespace plastron::test {

inline constexpr double no_bound = std::numeric_limits<double>::infinity();

struct PressedDense {
  DenseProblem box;
  Eigen::MatrixXd lower_shape, upper_shape;  ///< a column for each force
  Eigen::VectorXd force;
  DenseProblem at(const Eigen::VectorXd& positions) const {
    DenseProblem moved = box;
    moved.lower += lower_shape * positions;
    moved.upper += upper_shape * positions;
    return moved;
  }
};

struct PressedSolution {
  Eigen::VectorXd z, positions;
  double energy = 0;
};

struct DistributedPressed {
  explicit DistributedPressed(const PressedDense& dense) : distributed(dense.box) {
    const auto part = [&](const Eigen::VectorXd& v) {
      return vector_of(distributed.matrix.layout(), 1, [&](GlobalIndex i) { return v(i); });
    };
    for (Eigen::Index k = 0; k < dense.force.size(); ++k)
      distributed.box->pressing.push_back({.lower_shape = part(dense.lower_shape.col(k)),
                                           .upper_shape = part(dense.upper_shape.col(k)),
                                           .force = dense.force(k)});
  }
  const contact::BoxProblem& problem() const { return *distributed.box; }
  const Matrix& matrix() const { return distributed.matrix; }

  DistributedProblem distributed;
};

inline double energy_of(const PressedDense& dense, const Eigen::VectorXd& z, const Eigen::VectorXd& positions) {
  return 0.5 * z.dot(dense.box.A * z) - dense.box.b.dot(z) - dense.force.dot(positions);
}

inline Eigen::VectorXd positions_of(const contact::BoxSolution& solution) {
  return Eigen::Map<const Eigen::VectorXd>(solution.positions.data(),
                                           static_cast<Eigen::Index>(solution.positions.size()));
}

/// The bound at which an unknown is, and how it moves. side: 0 free, 1 at its lower, 2 at its upper bound.
inline Eigen::VectorXd side_of(const std::vector<int>& side, const Eigen::VectorXd& lower,
                               const Eigen::VectorXd& upper) {
  Eigen::VectorXd held = Eigen::VectorXd::Zero(lower.size());
  for (Eigen::Index i = 0; i < held.size(); ++i) {
    const int s = side[static_cast<std::size_t>(i)];
    if (s != 0) held(i) = s == 1 ? lower(i) : upper(i);
  }
  return held;
}

/// z = held + P y + H delta minimises over (y, delta) on the subproblem; empty if that has no minimiser.
inline std::optional<PressedSolution> minimise_with_border(const PressedDense& dense, const std::vector<int>& side) {
  const Eigen::Index n = dense.box.size(), m = dense.force.size();
  const Eigen::VectorXd held = side_of(side, dense.box.lower, dense.box.upper);
  const auto is_free = std::count(side.begin(), side.end(), 0);
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, is_free + m);
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    if (side[static_cast<std::size_t>(i)] == 0) T(i, column++) = 1;
  for (Eigen::Index k = 0; k < m; ++k)
    T.col(is_free + k) = side_of(side, dense.lower_shape.col(k), dense.upper_shape.col(k));
  Eigen::VectorXd right = T.transpose() * (dense.box.b - dense.box.A * held);
  right.tail(m) += dense.force;
  const Eigen::MatrixXd K = T.transpose() * dense.box.A * T;
  const Eigen::LDLT<Eigen::MatrixXd> factor(K);
  if (!(factor.vectorD().minCoeff() > 1e-10 * K.diagonal().maxCoeff())) return {};
  const Eigen::VectorXd x = factor.solve(right);
  const Eigen::VectorXd z = held + T * x, positions = x.tail(m);
  return PressedSolution{.z = z, .positions = positions, .energy = energy_of(dense, z, positions)};
}

inline bool keeps_all_conditions(const PressedDense& dense, const std::vector<int>& side,
                                 const PressedSolution& solution) {
  const DenseProblem moved = dense.at(solution.positions);
  const double slack = 1e-9 * (1 + solution.z.cwiseAbs().maxCoeff() + solution.positions.cwiseAbs().maxCoeff());
  if (((moved.lower - moved.upper).array() > slack).any()) return false;
  return is_optimal(moved, side, solution.z);
}

/// The solution by trying all 3^n subproblems; empty if none has it.
inline std::optional<PressedSolution> brute_force(const PressedDense& dense) {
  const auto n = static_cast<std::size_t>(dense.box.size());
  std::vector<int> side(n, 0);
  for (;;) {
    bool exists = true;
    for (std::size_t i = 0; i < n; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      if (side[i] == 1 && std::isinf(dense.box.lower(k))) exists = false;
      if (side[i] == 2 && std::isinf(dense.box.upper(k))) exists = false;
      if (side[i] != 1 && dense.box.lower(k) == dense.box.upper(k)) exists = false;
    }
    if (exists) {
      const auto solution = minimise_with_border(dense, side);
      if (solution && keeps_all_conditions(dense, side, *solution)) return solution;
    }
    std::size_t digit = 0;
    while (digit < n && ++side[digit] == 3) side[digit++] = 0;
    if (digit == n) return {};
  }
}

/// random_problem() with forces on some of its bounds: lower bounds mostly rise with delta, upper ones mostly fall. Each force has one unknown
/// of its own that carries it. Unknowns with two bounds come between a moving and a resting one.
inline PressedDense random_pressed(Eigen::Index n, Eigen::Index forces, unsigned seed) {
  PressedDense dense{.box = random_problem(n, seed),
                     .lower_shape = Eigen::MatrixXd::Zero(n, forces),
                     .upper_shape = Eigen::MatrixXd::Zero(n, forces),
                     .force = Eigen::VectorXd(forces)};
  std::mt19937 random(seed + 77);
  std::uniform_real_distribution<double> size(0.2, 1.5);
  std::uniform_int_distribution<int> one_in_eight(0, 7);
  const auto shape = [&] { return (one_in_eight(random) == 0 ? -1 : 1) * size(random); };
  for (Eigen::Index k = 0; k < forces; ++k) {
    dense.force(k) = 2 * size(random);
    for (Eigen::Index i = forces; i < n; ++i) {
      if (dense.box.lower(i) == dense.box.upper(i)) continue;
      if (forces > 1 && i % forces != k && one_in_eight(random) != 0) continue;  // few unknowns have both bounds nearby
      if (std::isfinite(dense.box.lower(i)))
        dense.lower_shape(i, k) = shape();
      else if (std::isfinite(dense.box.upper(i)))
        dense.upper_shape(i, k) = -shape();
    }
    dense.box.lower(k) = -size(random);
    dense.box.upper(k) = no_bound;
    dense.lower_shape(k, k) = size(random);
  }
  return dense;
}

}  // namespace plastron::test

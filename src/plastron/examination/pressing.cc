// Checks whether the loads press the shell onto the obstacle.
#include <plastron/examination/rigid_motions.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plastron::examination {

namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

/// Returns G', one column for each contact row.
MatrixXd gap_changes(const RigidMotions& motions, const MatrixXd& held, const ShellPart& part,
                     const assembly::NodalCoordinates& coordinates) {
  std::vector<RigidMotion> touchable;
  for (std::size_t i = 0; i < part.nodes.size(); ++i)
    for (const assembly::ContactRow& row : coordinates.rows_of(part.nodes[i])) {
      const auto& gaps = coordinates.gaps[static_cast<std::size_t>(row.obstacle)];
      if (row.is_touchable()) touchable.push_back(motions.gap_change(part.points[i], gaps[row.node]));
    }
  MatrixXd changes(held.cols(), static_cast<Index>(touchable.size()));
  for (std::size_t k = 0; k < touchable.size(); ++k)
    changes.col(static_cast<Index>(k)) = held.transpose() * touchable[k];
  return changes;
}

VectorXd best_on(const MatrixXd& A, const std::vector<Index>& columns, const VectorXd& b) {
  const MatrixXd taken = A(Eigen::all, columns);
  return taken.colPivHouseholderQr().solve(b);
}

/// The active columns with their coefficients, all positive.
struct Passive {
  std::vector<Index> columns;
  VectorXd x;

  void drop_zeros() {
    std::vector<Index> kept;
    std::vector<double> values;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (x[static_cast<Index>(k)] > 0) {
        kept.push_back(columns[k]);
        values.push_back(x[static_cast<Index>(k)]);
      }
    columns = std::move(kept);
    x = Eigen::Map<VectorXd>(values.data(), static_cast<Index>(values.size()));
  }

  /// Moves x towards the best coefficients, and removes columns that become negative on the way.
  void settle(const MatrixXd& A, const VectorXd& b) {
    while (!columns.empty()) {
      const VectorXd s = best_on(A, columns, b);
      if (s.minCoeff() > 0) {
        x = s;
        return;
      }
      double step = 1;
      Index first = 0;
      for (Index k = 0; k < s.size(); ++k)
        if (s[k] <= 0 && x[k] / (x[k] - s[k]) <= step) {
          step = x[k] / (x[k] - s[k]);
          first = k;
        }
      x += step * (s - x);
      x[first] = 0;  // exactly, without a positive rounding error
      drop_zeros();
    }
  }
};

}  // namespace

VectorXd nonnegative_residual(const MatrixXd& A, const VectorXd& b) {
  Passive passive;
  VectorXd residual = b;
  if (A.cols() == 0) return residual;
  const double negligible = 1e-13 * b.norm() * A.colwise().norm().maxCoeff();
  // Each step lowers |residual|. The limit is necessary because rounding may undo a step.
  for (int step = 0; step < 100; ++step) {
    Index steepest = 0;
    if ((A.transpose() * residual).maxCoeff(&steepest) <= negligible) break;
    if (std::ranges::find(passive.columns, steepest) != passive.columns.end()) break;
    passive.columns.push_back(steepest);
    passive.x.conservativeResize(passive.x.size() + 1);
    passive.x.tail<1>()[0] = 0;
    // A new column may start at zero because its coefficient increases.
    passive.settle(A, b);
    residual = b;
    for (std::size_t k = 0; k < passive.columns.size(); ++k)
      residual -= passive.x[static_cast<Index>(k)] * A.col(passive.columns[k]);
  }
  return residual;
}

Pressing pressing(const RigidMotions& motions, const MatrixXd& held, const ShellPart& part,
                  const assembly::NodalCoordinates& coordinates, std::span<const double> forces) {
  // Rotations of a curved shell are only interpolated between nodes, so that works have errors of about 1e-5.
  // A shell that a thousandth of its load presses is hardly fixed.
  constexpr double unbalanced = 1e-4, margin = 1e-3;
  const MatrixXd G = gap_changes(motions, held, part, coordinates);
  VectorXd load = held.transpose() * motions.work(part, forces);
  double all_forces = 0;  // sums of magnitudes, not of squares: loads may be arbitrarily small
  for (const std::size_t node : part.nodes)
    for (const double force : forces.subspan(6 * node, 6)) all_forces += std::abs(force);
  const double works = load.lpNorm<1>();
  const bool does_work = works > 1e-9 * all_forces;
  load = does_work ? VectorXd((load / works).normalized()) : VectorXd::Zero(load.size());
  const auto motion_of = [&](const VectorXd& residual) { return RigidMotion(held * -residual.normalized()); };

  const VectorXd off = nonnegative_residual(G, -load);
  if (off.norm() > unbalanced) return {Hold::pulled_off, motion_of(off)};
  // The mean reaction is inside the cone of reactions. A pressed load stays pressed without a small part of it.
  const VectorXd least = nonnegative_residual(G, -load - margin * G.rowwise().mean().normalized());
  if (least.norm() > 1e-3 * margin) return {Hold::balanced, motion_of(least)};
  return {};
}

}  // namespace plastron::examination

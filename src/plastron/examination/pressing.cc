#include <plastron/examination/pressing.hpp>

#include <plastron/examination/nonnegative_least_squares.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace plastron::examination {

namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

/// Returns G', one column for each contact row.
MatrixXd gap_changes(const RigidMotions& motions, const MatrixXd& held, const std::vector<assembly::NodalPoint>& points,
                     const assembly::NodalCoordinates& coordinates) {
  std::vector<assembly::ContactRow> touchable;
  std::ranges::copy_if(coordinates.rows, std::back_inserter(touchable), &assembly::ContactRow::is_touchable);
  MatrixXd changes(held.cols(), static_cast<Eigen::Index>(touchable.size()));
  for (std::size_t k = 0; k < touchable.size(); ++k) {
    const auto& gaps = coordinates.gaps[static_cast<std::size_t>(touchable[k].obstacle)];
    changes.col(static_cast<Eigen::Index>(k)) =
        held.transpose() * motions.gap_change(points[touchable[k].node], gaps[touchable[k].node]);
  }
  return changes;
}

}  // namespace

Pressing pressing(const RigidMotions& motions, const MatrixXd& held, const std::vector<assembly::NodalPoint>& points,
                  const assembly::NodalCoordinates& coordinates, std::span<const double> forces) {
  // Rotations of a curved shell are only interpolated between nodes, so that works have errors of about 1e-5.
  // A shell that a thousandth of its load presses is hardly fixed.
  constexpr double unbalanced = 1e-4, margin = 1e-3;
  const MatrixXd G = gap_changes(motions, held, points, coordinates);
  VectorXd load = held.transpose() * motions.work(points, forces);
  double all_forces = 0;  // sums of magnitudes, not of squares: loads may be arbitrarily small
  for (const double force : forces) all_forces += std::abs(force);
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

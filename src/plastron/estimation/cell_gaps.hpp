// Gaps between the shell and an obstacle at points of a cell, and their changes by motions.
#pragma once
#include <plastron/estimation/derivatives.hpp>
#include <plastron/geometry/frame.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace plastron::estimation {

/// Gaps at the points of a `BasisAt`.
struct CellGaps {
  std::vector<obstacle::Gap> rows{};      ///< linearised at the state, without lifts
  std::vector<geometry::Frame> frames{};  ///< of the undeformed mid-surface
  Eigen::VectorXd values{};               ///< gaps of the solution [m]
};

/// Returns the change of a gap by a motion (u, r) of its point [m].
double opening(const assembly::DiscreteShell& discrete, const obstacle::Gap& gap, const Eigen::Vector3d& a3,
               const assembly::Vector6& motion);

/// Returns the gaps between an owned cell and an obstacle.
CellGaps cell_gaps(const Solved& solved, std::size_t cell, std::size_t obstacle, const element::BasisAt& at);
/// Returns the change of each gap by a motion y [m].
Eigen::VectorXd openings(const Solved& solved, std::size_t cell, const CellGaps& gaps, const element::BasisAt& at,
                         const algebra::Vector& y);

}  // namespace plastron::estimation

// The place of a solution's largest equivalent stress, away from places where stress has no limit.
#pragma once
#include <plastron/recovery/recovery.hpp>
#include <plastron/recovery/singular_places.hpp>

#include <span>

namespace plastron::recovery {

struct StressPeak {
  double von_mises = 0;                                ///< largest equivalent stress at a point of output [Pa]
  double error = 0;                                    ///< estimated error of the stress; NaN if unknown [Pa]
  double height = 0;                                   ///< height z of the stress, from the mid-surface along a_3 [m]
  Eigen::Vector2d x = Eigen::Vector2d::Zero();         ///< parameters in Omega
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< point on the undeformed mid-surface [m]
  int rank = 0;                                        ///< rank that owns the cell
  std::size_t cell = 0;
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();  ///< point in the cell
};

/// Searches equidistant points of all cells, as many per cell as its nodes, outside the radius of all singular
/// places. Among stresses equal up to rounding it takes the first in X, then Y, then Z, and the upper face before the
/// lower. Zero if no stress is finite. `error` is the difference to the resultants of the cell alone. The same result
/// on every rank (collective).
StressPeak stress_peak(const assembly::DiscreteShell& discrete, const NodalSolution& solution, const Choice& choice,
                       std::span<const SingularPlace> singular);

}  // namespace plastron::recovery

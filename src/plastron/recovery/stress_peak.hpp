// Where the equivalent stress of a solution is largest, away from places where it has no limit.
#pragma once
#include <plastron/certificate/singular_places.hpp>
#include <plastron/recovery/recovery.hpp>

#include <span>

namespace plastron::recovery {

struct StressPeak {
  double von_mises = 0;  ///< largest equivalent stress at a point of output [Pa]
  double error = 0;      ///< how far that is thought to be from the exact one; NaN if unknown [Pa]
  double height = 0;     ///< z of it, from the mid-surface along a_3 [m]
  Eigen::Vector2d x = Eigen::Vector2d::Zero();         ///< parameters in Omega
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the point of the undeformed mid-surface [m]
  int rank = 0;                                        ///< that owns the cell
  std::size_t cell = 0;
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();  ///< in the cell
};

/// At equidistant points of all cells, as many as they have nodes, that lie in the radius of no singular place; where several are
/// equal up to rounding, the first in X, then Y, then Z, and of both faces the upper one. Zero where nothing is finite. `error` is the difference to the
/// resultants of the cell alone. The same on every rank (collective).
StressPeak stress_peak(const assembly::DiscreteShell& discrete, const NodalSolution& solution, const Choice& choice,
                       std::span<const certificate::SingularPlace> singular);

}  // namespace plastron::recovery

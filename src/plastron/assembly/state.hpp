// Where a computation stands: what the shell is linearised at.
#pragma once
#include <plastron/algebra/vector.hpp>

#include <Eigen/Core>

#include <vector>

namespace plastron::assembly {

struct State {
  /// (u, r) of local nodes, six values a node, ghosts current; without a layout the shell is undeformed.
  algebra::Vector displacement{};
  double time = 0;                      ///< where moving obstacles stand, see obstacle::Obstacle::standing()
  double load_factor = 1;               ///< the loads are this multiple of what was given
  std::vector<double> force_factors{};  ///< of the forces that press obstacles; empty: 1
  std::vector<double> positions{};      ///< of pressed obstacles, along their forces; empty: 0 [m]
  /// What gaps at local nodes must not fall below in place of 0, obstacle by obstacle, ghosts current, so that the shell is out of the
  /// obstacles between its nodes, too; without a layout that is not wanted [m].
  algebra::Vector lifts{};

  bool is_deformed() const { return displacement.layout() != nullptr; }
  double force_factor(std::size_t obstacle) const { return force_factors.empty() ? 1 : force_factors[obstacle]; }
  double position(std::size_t obstacle) const { return positions.empty() ? 0 : positions[obstacle]; }
  bool is_admissible() const { return lifts.layout() != nullptr; }
  double lift(std::size_t node, std::size_t obstacle) const {
    return is_admissible() ? lifts.local()[node * static_cast<std::size_t>(lifts.block()) + obstacle] : 0;
  }
  /// (u, r) of a local node; zero for the undeformed shell.
  Eigen::Matrix<double, 6, 1> at(std::size_t node) const {
    if (!is_deformed()) return Eigen::Matrix<double, 6, 1>::Zero();
    return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(displacement.local().data() + 6 * node);
  }
};

}  // namespace plastron::assembly

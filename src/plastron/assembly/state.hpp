// Where a computation stands: what the shell is linearised at.
#pragma once
#include <plastron/algebra/vector.hpp>

#include <Eigen/Core>

namespace plastron::assembly {

struct State {
  /// (u, r) of local nodes, six values a node, ghosts current; without a layout the shell is undeformed.
  algebra::Vector displacement{};
  double time = 0;         ///< where moving obstacles stand, see obstacle::Obstacle::nearest()
  double load_factor = 1;  ///< the loads are this multiple of what was given

  bool is_deformed() const { return displacement.layout() != nullptr; }
  /// (u, r) of a local node; zero for the undeformed shell.
  Eigen::Matrix<double, 6, 1> at(std::size_t node) const {
    if (!is_deformed()) return Eigen::Matrix<double, 6, 1>::Zero();
    return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(displacement.local().data() + 6 * node);
  }
};

}  // namespace plastron::assembly

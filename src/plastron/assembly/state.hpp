// The state at which the shell is linearised, and the six values (u, r) of a node in a vector.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/energy/factors.hpp>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace plastron::assembly {

/// (u, r) of a node, or the force and couple that do work on them.
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Returns the values of a local node in a vector with six values for each node.
inline Vector6 node_values(const algebra::Vector& y, std::size_t node) {
  return Eigen::Map<const Vector6>(y.at(node).data());
}

/// The factor of the loads is sought with which u . direction has this value at a point of Omega.
struct Control {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double displacement = 0;  ///< [m]
  int factor = -1;          ///< the controlled one, see energy::Factors::controlled()
};

struct State {
  /// (u, r) of local nodes, six values for each node, with current ghosts. Without a layout the shell is undeformed.
  algebra::Vector displacement{};
  energy::Factors factors = energy::Factors();
  std::optional<Control> control{};  ///< with finite rotations
  std::vector<double> positions{};   ///< positions of pressed obstacles along their forces; empty: 0 [m]
  /// Lower limits of the gaps at local nodes in place of 0, by obstacle, with current ghosts [m]. They keep the shell
  /// out of the obstacles also between its nodes. Without a layout there are no such limits.
  algebra::Vector lifts{};

  bool is_deformed() const { return displacement.layout() != nullptr; }
  double position(std::size_t obstacle) const { return positions.empty() ? 0 : positions[obstacle]; }
  bool is_admissible() const { return lifts.layout() != nullptr; }
  double lift(std::size_t node, std::size_t obstacle) const { return is_admissible() ? lifts.at(node)[obstacle] : 0; }
  /// Returns (u, r) of a local node; zero for the undeformed shell.
  Vector6 at(std::size_t node) const {
    return is_deformed() ? node_values(displacement, node) : Vector6(Vector6::Zero());
  }
};

}  // namespace plastron::assembly

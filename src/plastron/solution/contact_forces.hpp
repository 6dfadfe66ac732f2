// The obstacles' reaction at each node.
#pragma once
#include <plastron/solution/nodal_solution.hpp>

#include <vector>

namespace plastron::solution {

/// A node that touches an obstacle. Its force is the reaction on the part of the shell represented by the node.
struct ContactForce {
  std::size_t obstacle = 0;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();  ///< parameters in Omega
  Vector3d place = Vector3d::Zero();            ///< on the touching face of the undeformed shell [m]
  Vector3d displacement = Vector3d::Zero();     ///< displacement of the mid-surface [m]
  Vector3d force = Vector3d::Zero();            ///< force on the shell, along the obstacle's normal [N]
  double pressure = 0;                          ///< eta [Pa]
  double area = 0;                              ///< mid-surface area represented by the node [m^2]
};

/// Returns the forces of all ranks on every rank, ordered by obstacle, then x, then y (collective).
std::vector<ContactForce> contact_forces(const assembly::DiscreteShell& discrete, const NodalSolution& solution);

}  // namespace plastron::solution

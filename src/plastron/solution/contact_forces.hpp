// The obstacles' reactions at nodes, and the contact along the edges of the shell.
#pragma once
#include <plastron/solution/nodal_solution.hpp>

#include <vector>

namespace plastron::solution {

using geometry::Vector3d;

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

/// Returns the generalised force on (u, r) of the row's node; zero where the row's obstacle does not touch it.
assembly::Vector6 contact_force(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                                const assembly::ContactRow& row);

/// Returns the forces of all ranks on every rank, ordered by obstacle, then x, then y (collective).
std::vector<ContactForce> contact_forces(const assembly::DiscreteShell& discrete, const NodalSolution& solution);

/// Contact along the edges of the shell. There the reaction may be concentrated on a line [N/m] (docs/model.md, section
/// 6), for example where a bowl turned over stands on its rim. Nodal reactions then decrease like h and not like h^2, and
/// a pressure would double with each refinement. The nodal reaction over the node's length of edge converges.
struct EdgeContact {
  std::int64_t nodes = 0;      ///< touching nodes on edges of the shell
  double force = 0;            ///< sum of their nodal reactions [N]
  double area = 0;             ///< mid-surface area represented by them [m^2]
  double max_per_length = 0;   ///< largest nodal reaction over its length of edge [N/m]
  double pressure_inside = 0;  ///< largest eta at the touching nodes that lie on no edge [Pa]

  /// Whether the edge carries a line reaction: its mean pressure is far above all pressure inside and is no density.
  bool is_line() const {
    constexpr double far_above = 3;
    return area > 0 && force > far_above * area * pressure_inside;
  }
};

/// Returns the local sides on edges of the shell, each once. Beyond joined edges and planes of symmetry the shell goes on: they are
/// none.
std::vector<fem::BoundarySide> edge_sides(const assembly::DiscreteShell& discrete);
/// Marks the local nodes on edges of the shell.
std::vector<char> nodes_on_edges(const assembly::DiscreteShell& discrete);

/// Computes the contact along edges (collective).
EdgeContact edge_contact(const assembly::DiscreteShell& discrete, const NodalSolution& solution);

}  // namespace plastron::solution

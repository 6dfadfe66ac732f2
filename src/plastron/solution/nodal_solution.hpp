// The solution at the nodes: displacement, rotation, pressure of each obstacle, multiplier.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/contact/problem.hpp>

namespace plastron::solution {

/// Nodal results of a solution, per local node with valid ghosts.
struct NodalSolution {
  algebra::Vector y;         ///< (u, r), block 6
  algebra::Vector pressure;  ///< eta_i of each obstacle [Pa]; block: number of obstacles, at least 1
  algebra::Vector touching;  ///< 1 where the node touches that obstacle, else 0; same block
  algebra::Vector lambda{};  ///< multiplier of (M14) [N m], block 1; without layout in the other formulations
};

/// The sum over all obstacles at a node.
double total_pressure(const NodalSolution& solution, std::size_t node);
bool touches(const NodalSolution& solution, std::size_t node);
/// Returns the largest |u| at a node of any rank (collective) [m].
double largest_displacement(const algebra::Vector& y);
/// Computes the largest |r| of nodal values (collective).
double largest_rotation(const algebra::Vector& y);

/// Computes eta_i from the residual at the nodes in the solution's active set (collective).
NodalSolution nodal_solution(const assembly::DiscreteShell& discrete, const contact::BoxSolution& solution);

/// Returns the solution at the state of a shell with finite rotations, in contact where `touching` is above one half; block:
/// obstacles (collective).
NodalSolution nodal_solution(const assembly::DiscreteShell& discrete, const algebra::Vector& touching);

/// Returns C' (A y + B' lambda - l) per owned node, computed from strains: forces at constrained nodes are added at the
/// nodes that these follow from (collective).
algebra::Vector residual(const assembly::DiscreteShell& discrete, const NodalSolution& solution);

}  // namespace plastron::solution

// Directors move on spheres and rigid bodies turn: the motions of the nodes are curved, and the forces on them do work at second order.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

namespace plastron::finite {

/// Adds the curvature of the nodes' motions at the state of the shell, or at its reference with small rotations. Its second
/// derivative along the rotations t of directors d and w of bodies is
///     - sum (f . d) |t|^2 / |d|^2 + sum f . (w x (w x p)),
/// f the couple on a node, and the force or couple on a node of a body with the arm or director p. `forces`: derivative of the energy
/// less all forces on owned nodes, without those on bodies, which act at reference points (Cartesian, block 6). The couples that the
/// sides of a kink exert on each other are not along directors, and count as constant (collective).
void add_curvature_of_motions(const assembly::DiscreteShell& discrete, algebra::Vector forces,
                              const assembly::NodalCoordinates& coordinates, algebra::Matrix& matrix);

}  // namespace plastron::finite

// Obstacles that forces press: how far they have come is an unknown of the contact problem beside (u, r). To first order an obstacle that
// goes s along the direction d of its force closes its gaps by s n . d, as in (M16) with the normals of where it was linearised.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <span>
#include <vector>

namespace plastron::assembly {

/// The obstacles that a force presses in the discrete shell's state, by their place in its list.
std::vector<std::size_t> pressed_obstacles(const DiscreteShell& discrete);

/// Their forces as the box program takes them, in the same order; positions are counted from where the obstacles stand.
std::vector<contact::PressingForce> pressing_forces(const DiscreteShell& discrete);

/// Moves the pressed obstacles on by `ways` [m] along their forces, and with them gaps and bounds; their normals stay, as the
/// linearisation has it (collective).
void press(DiscreteShell& discrete, std::span<const double> ways);

}  // namespace plastron::assembly

// Obstacles that forces press: their positions are unknowns of the contact problem beside (u, r). The obstacle moves by
// s along the direction d of its force. To first order this closes its gaps by s n . d, as in (M16) with the normals of
// the linearisation.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <span>
#include <vector>

namespace plastron::assembly {

/// Returns the obstacles that a force presses in the discrete shell's state, by their place in its list.
std::vector<std::size_t> pressed_obstacles(const DiscreteShell& discrete);

/// Returns the forces in the same order, in the form of the box program. Positions are measured from the obstacles'
/// present positions.
std::vector<contact::PressingForce> pressing_forces(const DiscreteShell& discrete);

/// Moves the pressed obstacles by `ways` [m] along their forces, and changes gaps and bounds. The normals stay, as in
/// the linearisation (collective).
void press(DiscreteShell& discrete, std::span<const double> ways);

}  // namespace plastron::assembly

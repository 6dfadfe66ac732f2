// Obstacles whose pressing force is 0 at an instant. They exert no force: the shell is solved without them, and they then
// stand where it leaves them.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <vector>

namespace plastron::computation {

/// Returns the obstacles that a force presses in other instants, and none in the state of the shell.
std::vector<std::size_t> unpressed_obstacles(const assembly::DiscreteShell& discrete);

/// Linearises the shell at its state without their bounds (collective).
void release(assembly::DiscreteShell& discrete, const std::vector<std::size_t>& unpressed);

/// Moves them back along their forces until the shell at `y` does not reach into them, and linearises the shell there with their
/// bounds (collective). Throws ObstacleError.
void put_back(assembly::DiscreteShell& discrete, const std::vector<std::size_t>& unpressed, const algebra::Vector& y);

}  // namespace plastron::computation

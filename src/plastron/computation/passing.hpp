// Checks whether a moving obstacle could pass through the shell. Solved in one step, it would then be met on its far
// side or not at all.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

namespace plastron::computation {

/// Whether an obstacle that moves from one time to another changes sides of the shell. The shell rests at `y`, and the
/// obstacle is near enough to touch it. It would face one side of the shell before and the other side after. For
/// motions below a quarter of the thickness, the shell's fibres find the correct side (obstacle/gap.hpp) (collective).
/// Throws ObstacleError.
bool may_pass(const assembly::DiscreteShell& discrete, const algebra::Vector& y, double from, double to);

}  // namespace plastron::computation

// Whether a moving obstacle could pass through the shell: solved in one go, it would be met on its far side, as far as it is met at all.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

namespace plastron::computation {

/// Whether an obstacle that moves from one time to another changes sides of the shell that rests where `y` has it, near enough to touch it:
/// it would look at one face before and at the other one after. Ways below a quarter of the thickness are short enough for the shell's
/// fibres to tell (obstacle/gap.hpp) (collective). Throws ObstacleError.
bool may_pass(const assembly::DiscreteShell& discrete, const algebra::Vector& y, double from, double to);

}  // namespace plastron::computation

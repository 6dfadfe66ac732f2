// Whether a moving obstacle could pass through the shell in one step, and the longest part of its way that is safe.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/problem/instants.hpp>

namespace plastron::computation {

/// Whether an obstacle that moves from one time to another changes sides of the shell. The shell rests at `y`, and the
/// obstacle is near enough to touch it. It would face one side of the shell before and the other side after. For
/// motions below a quarter of the thickness, the shell's fibres find the correct side (obstacle/gap.hpp) (collective).
/// Throws ObstacleError.
bool may_pass(const assembly::DiscreteShell& discrete, const algebra::Vector& y, double from, double to);

/// Returns the next part of the way between two instants, after `done`. It is so short that obstacles cannot pass
/// through the shell at `y`.
double next_part(const assembly::DiscreteShell& discrete, const algebra::Vector& y, const problem::Instant& from,
                 const problem::Instant& to, double done);

}  // namespace plastron::computation

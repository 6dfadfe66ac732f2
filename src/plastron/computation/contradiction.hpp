// Why there is no solution, in words: bounds leave the shell no room, or a motion has no stiffness.
#pragma once
#include <plastron/solution/nodal_solution.hpp>

#include <string>

namespace plastron::computation {

/// Returns the obstacles whose bounds contradict each other or a support, with the place where most room is missing; empty if
/// none do (collective).
std::string contradiction_text(const assembly::DiscreteShell& discrete);

/// Names the motion of least stiffness at a state of a shell with finite rotations that is no equilibrium, and the place that it
/// moves most; empty if it is not found (collective).
std::string softest_motion_text(const assembly::DiscreteShell& discrete, const solution::NodalSolution& nodal);

}  // namespace plastron::computation

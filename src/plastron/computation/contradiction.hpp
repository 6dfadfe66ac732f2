// Where bounds leave the shell no room: which obstacles, and how much is missing.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <string>

namespace plastron::computation {

/// Returns the obstacles whose bounds contradict each other or a support, with the place where most room is missing; empty if
/// none do (collective).
std::string contradiction_text(const assembly::DiscreteShell& discrete);

}  // namespace plastron::computation

// The path to an instant whose results are requested: instants between are solved where an obstacle could pass through the
// shell, where the shell snaps or where no equilibrium is found in one part.
#pragma once
#include <plastron/computation/step_control.hpp>

#include <memory>
#include <optional>

namespace plastron::computation {

/// Solves an instant from the undeformed shell `discrete`. If an obstacle may pass or a motion loses its stiffness in one part, it
/// goes there in parts; where parts do not help, the result is that of one part (collective).
LevelResult solved_from_start(Run& run, const problem::Instant& to, LevelTask task,
                              std::unique_ptr<assembly::DiscreteShell> discrete);

/// Goes to an instant in parts from the undeformed shell `discrete`, by the instants before it; empty if that fails (collective).
std::optional<LevelResult> solved_in_parts(Run& run, const problem::Instant& to, const LevelTask& task,
                                           std::unique_ptr<assembly::DiscreteShell> discrete, const Pace& pace);

/// Goes from the solution at hand to an instant. `solve` solves it, and the instants before it if the step chooses its parts
/// (collective).
bool approach(Run& run, const problem::Instant& from, const problem::Instant& to, const Solve& solve);

}  // namespace plastron::computation

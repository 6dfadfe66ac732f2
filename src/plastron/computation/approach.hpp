// Intermediate instants for moving obstacles. Solved in one step, an obstacle could pass through the shell: it would then
// touch the far side or nothing. Instants between are solved so that each motion is short.
#pragma once
#include <plastron/computation/run.hpp>

#include <memory>

namespace plastron::computation {

/// Solves intermediate instants from the solution at hand, after the part `done` of the way between two instants
/// (collective).
bool approach(Run& run, const problem::Instant& from, const problem::Instant& to, double done = 0);

/// The same, starting from the undeformed shell `discrete`. It stays if no instant is needed; otherwise it becomes the
/// shell of the solution at hand (collective).
bool approach_from_start(Run& run, std::unique_ptr<assembly::DiscreteShell>& discrete, const problem::Instant& to);

}  // namespace plastron::computation

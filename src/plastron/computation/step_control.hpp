// Parts of a step that are chosen by how the iteration goes: shorter where it finds no equilibrium or where the shell jumps to
// another one, longer where few Newton steps suffice.
#pragma once
#include <plastron/computation/run.hpp>

#include <functional>

namespace plastron::computation {

/// Result of an attempt to solve an instant.
struct Attempt {
  bool is_accepted = false;
  bool may_go_on = false;  ///< a shorter part may be tried, or the next one
  int newton_steps = 0;
};

/// Judges a level at the end of a part of a step of this length. Failures and jumps are rejected as long as a shorter part can be
/// tried. In the end a jump is accepted: the shell snaps there.
Attempt judged(const Level& level, double part);

/// Solves an instant from a departure, after a part of the step of this length. After a rejection there is a solution at hand,
/// which nothing uses.
using Solve = std::function<Attempt(const problem::Instant& instant, const Departure& departure, double part)>;

/// Goes from the solution at hand, that of `from`, to another instant (collective).
bool go_in_parts(Run& run, const problem::Instant& from, const problem::Instant& to, const Solve& solve);

}  // namespace plastron::computation

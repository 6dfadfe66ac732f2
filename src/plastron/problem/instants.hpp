// The times at which a problem is solved: the ends of the parts of its steps.
#pragma once
#include <plastron/assembly/state.hpp>
#include <plastron/problem/problem.hpp>

#include <vector>

namespace plastron::problem {

struct Instant {
  int step = 0;  ///< counted from 0
  energy::Factors factors = energy::Factors();
  const Control* control = nullptr;  ///< if given, the factor of the loads follows from it
  double part = 1;                   ///< completed part of the step
  bool chooses_parts = false;        ///< the way to it from the instant before goes in parts that are chosen
  /// Part of the depth of the undeformed shell in obstacles that is still left: they come in on the way from the start.
  double overlap = 0;
};

/// Returns an instant at `part` of the way from one instant to a later one.
Instant between(const Instant& from, const Instant& to, double part);

/// Returns the start: no loads, no forces, nothing has moved, and obstacles lie outside of the shell.
Instant start(const Problem& problem);

/// Returns the instants. In each step, loads, forces and prescribed components change in equal parts from their earlier
/// factors to the factors of the step; before the first step they are 0. A problem without steps has one instant, at time
/// 0, with all of them. Of a step that chooses its parts they have the end, and a first part if it is the first step.
std::vector<Instant> instants(const Problem& problem);

/// Returns the control of an instant. `start`: value of u . direction at the start of its step [m].
std::optional<assembly::Control> control_of(const Problem& problem, const Instant& instant, double start);

}  // namespace plastron::problem

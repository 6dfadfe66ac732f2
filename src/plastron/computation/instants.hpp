// The points of time at which a problem is solved: the ends of the parts of its steps.
#pragma once
#include <plastron/computation/problem.hpp>

#include <vector>

namespace plastron::computation {

struct Instant {
  int step = 0;                         ///< counted from 0
  double time = 0;                      ///< steps that are over, the part of this one included
  double load_factor = 1;               ///< of all loads
  std::vector<double> force_factors{};  ///< of the forces that press obstacles; empty: 1
};

/// A part of the way from one instant to a later one.
Instant between(const Instant& from, const Instant& to, double part);

/// In each step, loads and forces go in equal parts from their factors before to those of the step; before the first they are 0. A
/// problem without steps has one instant, at time 0, with all of its loads.
std::vector<Instant> instants(const Problem& problem);

}  // namespace plastron::computation

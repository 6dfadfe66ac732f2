// Decides when an available factor is cheaper than a new one. It counts operations, so that the decision is the same in
// every run.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/settings.hpp>

#include <algorithm>
#include <cstdint>

namespace plastron::contact {

/// Returns the number of conjugate-gradient steps that cost less than pinning another set of unknowns. A step is an
/// application of the preconditioner and two products through strains. `per_unknown`: operations of a factorisation by
/// one thread that take the same time as one unknown in two products, which form strains
/// (benchmarks/step_cost; docs/performance.md).
inline int affordable_steps(const algebra::Price& price, double unknowns) {
  constexpr double per_unknown = 2200;
  const double step = price.apply + per_unknown * unknowns;
  return step > 0 ? static_cast<int>(price.pin / step) : 0;
}

/// Returns the number of steps to try with the available factor after `changes` changed unknowns; 0: factorise anew.
/// Conjugate gradients need about one step for each changed unknown, fewer where the problem has symmetries.
inline int steps_to_try(KeptFactor rule, const algebra::Price& price, double unknowns, std::int64_t changes) {
  constexpr int most_steps = 16, most_changes = 64;
  if (rule == KeptFactor::always) return changes <= most_changes ? most_steps : 0;
  const int affordable = std::min(most_steps, affordable_steps(price, unknowns));
  return changes < affordable ? affordable : 0;
}

}  // namespace plastron::contact

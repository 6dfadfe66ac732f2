// When a factor that is at hand is cheaper than a new one: by counts, so that the decision is the same in every run.
#pragma once
#include <plastron/algebra/factorisation.hpp>

namespace plastron::contact {

/// How many conjugate-gradient steps, each a solve and two products through strains, cost less than a new factorisation with one
/// thread. A solve waits for memory and a product counts strains, hence the weights: operations of a factorisation that take
/// as long as one entry of the factor in a solve and as one unknown in two products (benchmarks/step_cost; docs/performance.md).
inline int affordable_steps(const algebra::FactorisationCost& factor, double unknowns) {
  constexpr double per_entry = 30, per_unknown = 17000;
  const double step = per_entry * factor.entries + per_unknown * unknowns;
  return step > 0 ? static_cast<int>(factor.operations / step) : 0;
}

}  // namespace plastron::contact

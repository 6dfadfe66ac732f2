// When a factor that is at hand is cheaper than a new one: by counts, so that the decision is the same in every run.
#pragma once
#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/threads.hpp>
#include <plastron/contact/settings.hpp>

#include <algorithm>
#include <cstdint>

namespace plastron::contact {

/// How many conjugate-gradient steps, each a solve and two products through strains, cost less than a new factorisation. A solve
/// waits for memory and a product counts strains, hence the weights: operations of a factorisation by one thread that take as long as
/// one entry of the factor in a solve and as one unknown in two products (benchmarks/step_cost; docs/performance.md).
inline int affordable_steps(const algebra::FactorisationCost& factor, double unknowns) {
  constexpr double per_entry = 65, per_unknown = 19000;
  const double step = per_entry * factor.entries + per_unknown * unknowns;
  return step > 0 ? static_cast<int>(factor.operations / algebra::threads_for(factor.operations) / step) : 0;
}

/// Steps to try with a factor at hand when so many unknowns have changed since; 0: factorise anew. Conjugate gradients need about as many
/// steps as unknowns have changed, fewer where the problem has symmetries.
inline int steps_to_try(KeptFactor rule, const algebra::FactorisationCost& factor, double unknowns,
                        std::int64_t changes) {
  constexpr int most_steps = 16, most_changes = 64;
  if (rule == KeptFactor::always) return changes <= most_changes ? most_steps : 0;
  const int affordable = std::min(most_steps, affordable_steps(factor, unknowns));
  return changes < affordable ? affordable : 0;
}

}  // namespace plastron::contact

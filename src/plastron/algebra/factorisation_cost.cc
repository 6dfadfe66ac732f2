#include <plastron/algebra/factorisation_cost.hpp>

#include <plastron/algebra/threads.hpp>

namespace plastron::algebra {

Price price_of(const FactorisationCost& cost) {
  constexpr double per_entry_made = 300, per_entry_solved = 65;
  return {.fix = cost.operations / threads_for(cost.operations) + per_entry_made * cost.entries,
          .apply = per_entry_solved * cost.entries};
}

}  // namespace plastron::algebra

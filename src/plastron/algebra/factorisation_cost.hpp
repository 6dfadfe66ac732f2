// The cost of a Cholesky factorisation.
#pragma once
#include <plastron/algebra/preconditioner.hpp>

namespace plastron::algebra {

/// Cost predicted by the analysis of the pattern, over all ranks. It is the same in every run.
struct FactorisationCost {
  double operations = 0;  ///< operations of one numeric factorisation
  double entries = 0;     ///< entries of the factor; a solve reads each of them twice
  /// Entries on the path from an unknown's own entries to the last unknown; a solve of one equation reads them. Mean; 0
  /// if not known.
  double entries_of_path = 0;
};

/// Returns this cost in the unit of other preconditioners.
Price price_of(const FactorisationCost& cost);

}  // namespace plastron::algebra

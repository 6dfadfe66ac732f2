// In which order the unknowns of one rank's matrix are eliminated, and the pattern that its factor gets. Both are found from nodes instead of
// unknowns, since all unknowns of a node are coupled with the same ones: a graph of a 25th of the edges. Unknowns that shall come last stand
// alone. Includes CHOLMOD: for .cc files only.
#pragma once
#include <plastron/algebra/factorisation.hpp>

#include <suitesparse/cholmod.h>

#include <span>
#include <vector>

#include "matrix_storage.hpp"

namespace plastron::algebra {

struct Elimination {
  std::vector<int> place{};  ///< of each unknown in the order
  int last = 0;              ///< so many unknowns at the end are those that shall come last
  FactorisationCost cost{};
};

/// The order for A, of one rank, and in `factor` the pattern of its Cholesky factor by supernodes, unknowns numbered by `Elimination::place`;
/// the caller frees it. last[i] != 0 for the unknowns that shall come last; empty: none. Throws std::bad_alloc.
Elimination eliminate(const Matrix::Storage& A, std::span<const char> last, cholmod_common& common,
                      cholmod_factor*& factor);

/// Throws what CHOLMOD's last call has to complain of: std::bad_alloc, std::runtime_error. A matrix that is not positive definite is no complaint.
void cholmod_check(const cholmod_common& common, const char* doing);

}  // namespace plastron::algebra

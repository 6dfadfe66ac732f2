// The elimination order of the unknowns of one rank's matrix, and the pattern of its factor. Both are computed from
// nodes instead of unknowns: all unknowns of a node are coupled with the same unknowns, so the graph has 1/25 of the
// edges. Unknowns that must come last are separate vertices. Includes CHOLMOD: for .cc files only.
#pragma once
#include <plastron/algebra/factorisation_cost.hpp>

#include <suitesparse/cholmod.h>

#include <span>
#include <vector>

#include "matrix_storage.hpp"

namespace plastron::algebra {

struct Elimination {
  std::vector<int> place{};  ///< place of each unknown in the order
  int last = 0;              ///< number of unknowns at the end that must come last
  FactorisationCost cost{};
};

/// Returns the order for A, of one rank. `factor` gets the pattern of its Cholesky factor by supernodes, with unknowns
/// numbered by `Elimination::place`; the caller frees it. last[i] != 0 for the unknowns that must come last; empty:
/// none. Throws std::bad_alloc.
Elimination eliminate(const MatrixStorage& A, std::span<const char> last, cholmod_common& common,
                      cholmod_factor*& factor);

/// Throws the error of CHOLMOD's last call: std::bad_alloc, std::runtime_error. A matrix that is not positive definite
/// is not an error.
void cholmod_check(const cholmod_common& common, const char* doing);

}  // namespace plastron::algebra

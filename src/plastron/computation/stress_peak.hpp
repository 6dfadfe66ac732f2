// How a solution's resultants are recovered, and where its stresses are largest.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>

namespace plastron::computation {

/// Sets solution.recovery as the problem wants it; to be done again when the solution changes (collective).
void choose_recovery(const Output& output, Solution& solution);

/// The largest equivalent stress over the thickness at equidistant points of all cells, as many as they have nodes; of equal ones the first in
/// x, then y. All NaN-free zero where nothing is finite. The same on every rank (collective).
StressPeak stress_peak(const Solution& solution);

}  // namespace plastron::computation

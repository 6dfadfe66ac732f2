// How a solution's resultants are recovered, and where its stresses are largest.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>

namespace plastron::computation {

/// Sets solution.recovery as the problem wants it; to be done again when the solution changes (collective).
void choose_recovery(const Output& output, Solution& solution);

/// The largest equivalent stress over the thickness at equidistant points of all cells, as many as they have nodes; where several are
/// equal up to rounding, the first in X, then Y, then Z, and of both faces the upper one. Zero where nothing is finite. The same on
/// every rank (collective).
StressPeak stress_peak(const Solution& solution);

}  // namespace plastron::computation

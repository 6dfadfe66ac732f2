// The contact solvers and their referees on one mesh sequence, side by side (docs/methods/compare.md).
#pragma once
#include <research/study/kinds.hpp>

namespace plastron::study {

/// A row a solver: seconds of the contact solution, iterations, those of a safeguard, conjugate-gradient steps, factorisations, all summed over
/// the meshes; energy 1/2 a(U, U) of the finest and its relative difference from the first solver's; whether the certificate holds.
/// Claims: each solver finds the first one's energy to 1e-8 and a certificate that holds. (collective)
Report compare_solvers(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                       const StudyObserver& observer);

}  // namespace plastron::study

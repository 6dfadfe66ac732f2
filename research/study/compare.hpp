// All formulations on one mesh sequence, side by side (docs/methods/compare.md).
#pragma once
#include <research/study/kinds.hpp>

namespace plastron::study {

/// A row a formulation and mesh: energy, reaction, contact area, max |r . a_3|, norm of lambda, unknowns, steps, seconds, and
/// the differences from the tangent formulation on the same mesh. Formulations that the case rules out become remarks.
/// (collective)
Report compare(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
               const StudyObserver& observer);

}  // namespace plastron::study

// Study: how fast the error falls with the mesh size (docs/methods/study-convergence.md).
#pragma once
#include <research/study/kinds.hpp>

namespace plastron::study {

/// (collective)
Report convergence(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                   const StudyObserver& observer);

}  // namespace plastron::study

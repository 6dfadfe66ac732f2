// Study: how fast the error falls with the mesh size (docs/methods/study-convergence.md).
#pragma once
#include <plastron/study/kinds.hpp>

namespace plastron::study {

/// (collective)
Report convergence(const computation::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                   const StudyObserver& observer);

}  // namespace plastron::study

// Study: the solution against perturbations of load, thickness and obstacle (docs/methods/study-continuity.md).
#pragma once
#include <plastron/study/kinds.hpp>

namespace plastron::study {

/// (collective)
Report continuity(const Problem& problem, const StudyOptions& options, MPI_Comm comm, const StudyObserver& observer);

}  // namespace plastron::study

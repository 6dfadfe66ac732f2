// Study: the solution against perturbations of load, thickness and obstacle (docs/methods/study-continuity.md).
#pragma once
#include <research/study/kinds.hpp>

namespace plastron::study {

/// (collective)
Report continuity(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                  const StudyObserver& observer);

/// The thickest shell it may compute.
std::vector<Variant> continuity_variants(const problem::Problem& problem, const StudyOptions& options);

}  // namespace plastron::study

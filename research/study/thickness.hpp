// Study: the limit of zero thickness, bending or membrane dominated (docs/methods/study-thickness.md).
#pragma once
#include <research/study/kinds.hpp>

namespace plastron::study {

/// (collective)
Report thickness(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                 const StudyObserver& observer);

/// The thicknesses it computes.
std::vector<Variant> thickness_study_variants(const problem::Problem& problem, const StudyOptions& options);

}  // namespace plastron::study

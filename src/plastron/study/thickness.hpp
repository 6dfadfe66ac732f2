// Study: the limit of zero thickness, bending or membrane dominated (docs/methods/study-thickness.md).
#pragma once
#include <plastron/study/kinds.hpp>

namespace plastron::study {

/// (collective)
Report thickness(const computation::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                 const StudyObserver& observer);

/// The thicknesses it computes.
std::vector<Variant> thickness_study_variants(const computation::Problem& problem, const StudyOptions& options);

}  // namespace plastron::study

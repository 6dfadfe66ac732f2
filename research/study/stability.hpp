// Study: the constants on which the well-posedness of the discrete problems rests (docs/methods/study-stability.md).
#pragma once
#include <research/study/kinds.hpp>

namespace plastron::study {

/// Coercivity and inf-sup constants over mesh size and thickness. (collective)
Report stability(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                 const StudyObserver& observer);
/// The thicknesses it computes.
std::vector<Variant> stability_variants(const problem::Problem& problem, const StudyOptions& options);

/// Finds the softest modes of the shell without supports, in every formulation, over the mesh size. (collective)
Report soft_modes(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                  const StudyObserver& observer);

}  // namespace plastron::study

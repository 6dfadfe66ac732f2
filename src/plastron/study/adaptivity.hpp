// Study: what an accuracy costs on meshes that follow from estimated errors and on uniform ones, and how far the estimates are true
// (docs/methods/study-adaptivity.md).
#pragma once
#include <plastron/study/kinds.hpp>

namespace plastron::study {

/// (collective)
Report adaptivity(const computation::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                  const StudyObserver& observer);

/// The problem on uniform meshes, for studies that compare these: a case that leaves meshes to its accuracy gets the refinements of the
/// default.
computation::Problem on_uniform_meshes(computation::Problem problem);

}  // namespace plastron::study

// Study: what an accuracy costs on meshes that follow from estimated errors and on uniform ones, and how far the estimates are true
// (docs/methods/study-adaptivity.md).
#pragma once
#include <research/study/kinds.hpp>

namespace plastron::study {

/// (collective)
Report adaptivity(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                  const StudyObserver& observer);

/// The problem on uniform meshes, for studies that compare these: a case that leaves meshes to its accuracy gets the refinements of the
/// default.
problem::Problem on_uniform_meshes(problem::Problem problem);

}  // namespace plastron::study

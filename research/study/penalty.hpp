// Study: the penalty going to zero (docs/methods/study-penalty.md).
#pragma once
#include <research/study/kinds.hpp>

namespace plastron::study {

/// |U_p - U|_a for p = 1, 1/10, ... until what locks is no longer the solution: the paper's Theorem 3 and Remark 4. (collective)
Report penalty(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
               const StudyObserver& observer);

/// The two formulations it sets against each other.
std::vector<Variant> penalty_variants(const problem::Problem& problem, const StudyOptions& options);

}  // namespace plastron::study

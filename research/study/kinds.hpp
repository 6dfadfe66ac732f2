// The list of all studies: each computes a case many times and examines a theorem or a limit with the results.
#pragma once
#include <plastron/examination/examine.hpp>
#include <research/names/study_names.hpp>
#include <research/study/report.hpp>

#include <mpi.h>

#include <span>
#include <string_view>
#include <vector>

namespace plastron::study {

struct Kind {
  std::string_view name;
  Report (*run)(const problem::Problem&, const StudyOptions&, MPI_Comm, const StudyObserver&);  ///< collective
  /// Problems that the study must compute besides the case. Null if the study needs only problems that cannot be refused.
  std::vector<Variant> (*variants)(const problem::Problem&, const StudyOptions&) = nullptr;
  bool grades_meshes = false;           ///< meshes follow from the case's accuracy; others compare uniform ones
  bool takes_finite_rotations = false;  ///< others examine theorems and formulations of the linear model
};

/// All studies, in the order of kind_names(). A new one is a line there and one in kinds.cc.
std::span<const Kind> kinds();
/// Null if there is no study of this name.
const Kind* find_kind(std::string_view name);
/// The comparison of formulations that `plastron compare` runs.
const Kind& comparison();
/// The comparison of solvers that `plastron compare --solvers` runs.
const Kind& solver_comparison();

/// The findings of the case, as for `run`, and the errors of the other problems that the study computes. The study must not
/// be run if there are errors. The same on every rank.
std::vector<examination::Finding> examine(const Kind& kind, const problem::Problem& problem,
                                          const StudyOptions& options);

}  // namespace plastron::study

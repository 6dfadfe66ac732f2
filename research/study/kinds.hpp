// The studies: each computes a case many times and examines a theorem or a limit with what it finds.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/io/plot.hpp>
#include <plastron/problem/problem.hpp>
#include <research/names/kind_names.hpp>
#include <research/names/study_options.hpp>
#include <research/study/mesh_picture.hpp>
#include <research/study/table.hpp>

#include <mpi.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::study {

struct StudyObserver {
  std::function<void(std::string_view what)> stage{};  ///< the next computation, in words; may be empty
  computation::Observer solve{};                       ///< of each computation
};

/// The result of a study. With a status other than solved the table ends at the computation that failed.
struct Report {
  contact::Status status = contact::Status::solved;
  Table table;
  io::Plot plot;
  std::vector<MeshPicture> meshes{};  ///< where the study is about them
};

/// A problem that a study computes beside the case, in words and as it is.
struct Variant {
  std::string what;
  problem::Problem problem;
};

struct Kind {
  std::string_view name, question;
  Report (*run)(const problem::Problem&, const StudyOptions&, MPI_Comm, const StudyObserver&);  ///< collective
  /// Members of StudyOptions it looks at, as the command line calls them ("steps" are "factors" in other words).
  std::span<const std::string_view> options{};
  /// Problems that the study must compute besides the case. Null if the study needs only problems that cannot be refused.
  std::vector<Variant> (*variants)(const problem::Problem&, const StudyOptions&) = nullptr;
  bool grades_meshes = false;  ///< meshes follow from the case's accuracy; others compare uniform ones
};

/// All studies, in the order of kind_names(). A new one is a line there and one in kinds.cc.
std::span<const Kind> kinds();
/// Null if there is no study of this name.
const Kind* find_kind(std::string_view name);
/// The comparison of formulations that `plastron compare` runs.
const Kind& comparison();
/// The comparison of solvers that `plastron compare --solvers` runs.
const Kind& solver_comparison();

/// The findings of the case, as for `run`, and the errors of what the study computes beside it: with errors the study is
/// not to be run. The same on every rank.
std::vector<examination::Finding> examine(const Kind& kind, const problem::Problem& problem,
                                          const StudyOptions& options);

}  // namespace plastron::study

// Reading and examining a case on all ranks together, for the command line and for Python.
#pragma once
#include <plastron/config/case.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/io/results.hpp>

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace plastron::workflow {

/// The mistakes of a case, in printed form.
struct RefusedCase : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Does `work`. Errors that the solution finds in the case become RefusedCase: in the mesh, the supports, the obstacles, the
/// loads, or in a function that the program gives.
void refusing(const std::function<void()>& work);

/// Returns the case that `read` returns. Each process reads the case file by itself, and the first one reads mesh files. If
/// one fails, all throw RefusedCase (collective).
config::Case read_together(const std::function<config::Case()>& read, MPI_Comm comm);

/// Returns the findings of `examination`, which must not communicate: the first rank runs it and sends them to the
/// others (collective).
std::vector<examination::Finding> examine_together(
    const std::function<std::vector<examination::Finding>()>& examination, MPI_Comm comm);

/// Returns "error", "warning" or "note".
const char* to_string(examination::Severity severity);

/// Returns the case file and the files that it names, before anything is solved; each rank reads the same files
/// (collective). Throws std::runtime_error.
io::CaseSource source_of(const config::Case& c, const std::filesystem::path& case_file,
                         const std::vector<std::string>& settings, MPI_Comm comm);

/// Returns the paths of the case file and of the files that it names: results must not replace them.
std::vector<std::filesystem::path> inputs_of(const config::Case& c, const std::filesystem::path& case_file);

}  // namespace plastron::workflow

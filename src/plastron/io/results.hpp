// results.json: the results of a computation, their certificate, and the settings. Its numbers are listed in
// quantities.cc and fields.cc, and for the reader in docs/results.md.
#pragma once
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/case_source.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/problem/unit_names.hpp>

#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

/// Data of results.json besides the result itself.
struct Provenance {
  std::string title;
  Json settings;                       ///< effective settings, including all defaults
  std::vector<std::string> files;      ///< written beside results.json
  std::optional<CaseSource> source{};  ///< the case file and the files that it names
  std::string solution{};              ///< one of `files`: the solution with all digits
  std::string case_copy{};             ///< one of `files`: the copy of the case file
  std::vector<double> heights{};       ///< z / e of additional stresses in the .vtu file, see fields_of()
  problem::UnitNames units{};          ///< names in the files
};

inline constexpr std::string_view results_name = "results.json";

/// Returns one record for each instant, with its obstacles and probes; empty without steps.
Json history_json(const computation::Result& result);
Json results_json(const computation::Result& result, const Provenance& provenance);

/// Adds directory/results.json to the files (collective; the text is rank 0's). Throws std::runtime_error.
void add_results(const computation::Result& result, const Provenance& provenance,
                 const std::filesystem::path& directory, AtomicFiles& files);
/// Writes results.json alone.
void write_results(const computation::Result& result, const Provenance& provenance,
                   const std::filesystem::path& directory, MPI_Comm comm);

}  // namespace plastron::io

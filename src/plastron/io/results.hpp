// results.json: the results of a computation, their certificate, and the settings. Its numbers are listed in
// quantities.cc and fields.cc, and for the reader in docs/results.md.
#pragma once
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/bytes.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/problem/unit_names.hpp>

#include <mpi.h>

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

/// The version of Plastron: that of the project in CMakeLists.txt.
extern const std::string_view version;

/// Missing or wrong parts of results from outside, in words for the user.
struct UnusableResults : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct SourceFile {
  std::string name;  ///< name as written in the case, relative to the case's folder
  Checksum checksum;
};

/// The source files of a computation. results.json describes them under "verification", so that `plastron verify` finds
/// them again and detects changed ones.
struct CaseSource {
  std::filesystem::path path;  ///< path of the case file, absolute
  std::string text;            ///< its bytes, as edited by settings
  std::vector<SourceFile> files{};
  std::vector<std::string> settings{};  ///< settings that replaced keys of the file
};

/// Returns the source with the files by name and path; reads these files (throws std::runtime_error).
CaseSource case_source(const std::filesystem::path& case_file, std::string text,
                       const std::vector<std::pair<std::string, std::filesystem::path>>& files);

/// Data of results.json besides the result itself.
struct Provenance {
  std::string title;
  Json settings;                                   ///< effective settings, including all defaults
  std::vector<std::string> files;                  ///< written beside results.json
  std::optional<CaseSource> source{};              ///< the case file and the files that it names
  std::string solution{};                          ///< one of `files`: the solution with all digits
  std::string case_copy{};                         ///< one of `files`: the copy of the case file
  std::vector<double> heights{};                   ///< z / e of additional stresses in the .vtu file, see fields_of()
  problem::UnitNames units{};                      ///< names in the files
  std::shared_ptr<const std::string> part_mesh{};  ///< of a case with a CAD file: its mesh, as text of a .msh file
};

inline constexpr std::string_view results_name = "results.json";
/// SHA-256 of all other files, for `plastron verify` and `sha256sum --check`.
inline constexpr std::string_view checksums_name = "SHA256SUMS";

/// Returns one record for each instant, with its obstacles and probes; empty without steps.
Json history_json(const computation::Result& result);
Json results_json(const computation::Result& result, const Provenance& provenance);

/// Adds directory/results.json to the files (collective; the text is rank 0's). Throws std::runtime_error.
void add_results(const computation::Result& result, const Provenance& provenance,
                 const std::filesystem::path& directory, AtomicFiles& files);

}  // namespace plastron::io

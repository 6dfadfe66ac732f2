// A results directory as it is handed over, and how what results.json claims compares with what was recomputed.
#pragma once
#include <plastron/io/results.hpp>
#include <plastron/io/unusable_results.hpp>

#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

/// What results.json says of itself and of its files.
struct Claims {
  Json results{};
  std::string status{};              ///< "solved"
  std::filesystem::path solution{};  ///< the file with all digits; empty where there was nothing to write
  std::filesystem::path case_copy{};
  Checksum case_checksum{};
  std::filesystem::path case_folder{};  ///< where the case was run from
  std::vector<SourceFile> files{};      ///< that the case names
};

/// Throws UnusableResults: no results, no JSON, nothing to verify it with (collective).
Claims read_claims(const std::filesystem::path& directory, MPI_Comm comm);

/// Throws UnusableResults where the copy of the case, or a file that it names and that lies in `folder`, is not what it
/// was when the case was run; all of them are named (collective).
void check_sources(const Claims& claims, const std::filesystem::path& folder, MPI_Comm comm);

/// How the files of results compare with SHA256SUMS.
struct StoredChecksums {
  std::size_t files = 0;                ///< that have a checksum
  std::vector<std::string> failures{};  ///< in words: which file has changed, is not there, or has no checksum
};
/// Compares them. Throws UnusableResults where there is no SHA256SUMS (collective).
StoredChecksums compare_checksums(const std::filesystem::path& directory, const Json& results, MPI_Comm comm);

/// One value of results.json beside the one that was recomputed.
struct Comparison {
  std::string path;  ///< "reaction.force[2]"
  Json recomputed, claimed;
  double tolerance = 0;  ///< of a number's difference
  bool agrees = false;
};

/// What numbers of a computation are large against, and how well they are reproduced.
struct Tolerances {
  explicit Tolerances(const computation::Result& recomputed);

  /// Of a quantity of that unit whose components are no larger than `magnitude`.
  double of(const std::string& unit, double magnitude) const;
  /// Part of the scales: 1e-9, for the order of sums depends on the number of ranks, and thin shells lose digits in
  /// strains: ten times the stationarity that is left.
  double rounding = 0;

 private:
  double force_ = 0, length_ = 0, size_ = 0, energy_ = 0, pressure_ = 0;
};

/// Every number of results.json that follows from the solution.
std::vector<Comparison> compare_numbers(const Json& claimed, const computation::Result& recomputed);
/// The settings that results.json claims and the case has otherwise.
std::vector<Comparison> differing_settings(const Json& claimed, const Json& of_case);

}  // namespace plastron::io

// A results directory from outside, and the comparison of the claims in results.json with recomputed values.
#pragma once
#include <plastron/io/results.hpp>

#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

/// Claims of results.json about itself and its files.
struct Claims {
  Json results{};
  std::string status{};              ///< "solved"
  std::filesystem::path solution{};  ///< the file with all digits; empty if there was nothing to write
  std::filesystem::path case_copy{};
  Checksum case_checksum{};
  std::filesystem::path case_folder{};  ///< folder from which the case was run
  std::vector<SourceFile> files{};      ///< files that the case names
};

/// Reads the claims. Throws UnusableResults: no results, no JSON, or nothing to verify (collective).
Claims read_claims(const std::filesystem::path& directory, MPI_Comm comm);

/// Throws UnusableResults where the copy of the case, or a file in `folder` that the case names, has changed since the
/// case was run; all of them are named (collective).
void check_sources(const Claims& claims, const std::filesystem::path& folder, MPI_Comm comm);

/// Comparison of the files of results with SHA256SUMS.
struct StoredChecksums {
  std::size_t files = 0;                ///< number of files with a checksum
  std::vector<std::string> failures{};  ///< in words: which file has changed, is missing, or has no checksum
};
/// Compares the files. Throws UnusableResults where there is no SHA256SUMS (collective).
StoredChecksums compare_checksums(const std::filesystem::path& directory, const Json& results, MPI_Comm comm);

/// One value of results.json and the recomputed value.
struct Comparison {
  std::string path;  ///< "reaction.force[2]"
  Json recomputed, claimed;
  double tolerance = 0;  ///< limit of a number's difference
  bool agrees = false;
};

/// Returns a value as text: numbers with nine digits, null as "-".
std::string shown(const Json& value);

/// Scales of the numbers of a computation, and their reproducibility.
struct Tolerances {
  explicit Tolerances(const computation::Result& recomputed);

  /// Returns the tolerance of a quantity of that unit whose components are at most `magnitude`.
  double of(const std::string& unit, double magnitude) const;
  /// Tolerance as a part of the scales: 1e-9, because the order of sums depends on the number of ranks. Thin shells
  /// lose digits in strains: ten times the remaining stationarity.
  double rounding = 0;

 private:
  double force_ = 0, length_ = 0, size_ = 0, energy_ = 0, pressure_ = 0;
};

/// Compares every number of results.json that follows from the solution.
std::vector<Comparison> compare_numbers(const Json& claimed, const computation::Result& recomputed);
/// Returns the settings that differ between results.json and the case.
std::vector<Comparison> differing_settings(const Json& claimed, const Json& of_case);

}  // namespace plastron::io

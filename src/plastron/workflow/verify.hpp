// Verification of written results, for the command line and for Python: the certificate is computed again from the
// files, and every number that follows from the solution is compared.
#pragma once
#include <plastron/computation/verify.hpp>
#include <plastron/config/case.hpp>
#include <plastron/io/claims.hpp>

#include <mpi.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plastron::workflow {

/// Recomputed numbers of written results, and the numbers that results.json claims.
struct Judgement {
  io::Json claimed{};                       ///< results.json
  std::optional<config::Case> read_case{};  ///< the copy of the case; absent if nothing was read
  computation::Verification recomputed{};   ///< rows with limits, and the solution
  std::vector<io::Comparison> numbers{};    ///< numbers that follow from the solution
  io::StoredChecksums files{};              ///< files with stored checksums
  std::vector<std::string> failures{};      ///< in words; empty: passed
};

/// Verifies the results in `directory`. `files`: folder of the files that the case names; empty: where the case was run.
/// Another status than "solved" is a failure, and the only one unless `reads_unsolved`: the solution is then read all the
/// same. Throws io::UnusableResults, RefusedCase, and the errors of computation::verify() (collective).
Judgement verify(const std::filesystem::path& directory, const std::filesystem::path& files, MPI_Comm comm,
                 bool reads_unsolved = false);

}  // namespace plastron::workflow

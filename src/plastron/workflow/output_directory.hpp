// The directory of results, before and during a computation.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::workflow {

/// First part of the names of a case's result files.
inline constexpr const char* base_name = "solution";

/// The directory of the results, tested before anything is solved. If nothing is kept at the end, the original state is
/// restored.
class OutputDirectory {
 public:
  /// Makes the directory and writes a file there, which it removes again (collective).
  OutputDirectory(const std::filesystem::path& directory, MPI_Comm comm);
  /// Makes the directory for the results of a case that is read from `inputs`; results must not replace these files.
  OutputDirectory(const std::filesystem::path& directory, const std::vector<std::filesystem::path>& inputs,
                  MPI_Comm comm);
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;
  ~OutputDirectory();

  /// Returns the reason why results cannot be written, equal on every rank; empty if they can.
  const std::string& obstacle() const { return obstacle_; }

 private:
  MPI_Comm comm_;
  std::vector<std::filesystem::path> made_{};
  std::string obstacle_{};
};

}  // namespace plastron::workflow

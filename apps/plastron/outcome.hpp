// The output directory of a command.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace plastron::app {

/// First part of the names of a case's result files.
inline constexpr const char* base_name = "solution";

/// The directory of the results, tested before anything is solved. If nothing is kept at the end, the original state is
/// restored.
class OutputDirectory {
 public:
  /// Makes the directory and writes a file there, which it removes again (collective).
  explicit OutputDirectory(const std::filesystem::path& directory);
  /// Makes the directory for the results of a case that is read from `inputs`; results must not replace these files.
  OutputDirectory(const std::filesystem::path& directory, const std::vector<std::filesystem::path>& inputs);
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;
  ~OutputDirectory();

  /// Returns the reason why results cannot be written, equal on every rank; empty if they can.
  const std::string& obstacle() const { return obstacle_; }

 private:
  std::vector<std::filesystem::path> made_{};
  std::string obstacle_{};
};

}  // namespace plastron::app

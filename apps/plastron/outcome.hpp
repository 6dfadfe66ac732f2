// Where a command writes.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace plastron::app {

/// Answers for the files of a case's results.
inline constexpr const char* base_name = "solution";

/// The directory of the results, tried before anything is solved. If nothing is kept in the end it is as it was before.
class OutputDirectory {
 public:
  /// Makes the directory and writes a file there, which it removes again (collective).
  explicit OutputDirectory(const std::filesystem::path& directory);
  /// For the results of a case that is read from `inputs`, which they must not replace.
  OutputDirectory(const std::filesystem::path& directory, const std::vector<std::filesystem::path>& inputs);
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;
  ~OutputDirectory();

  /// Why results cannot be written; empty if they can. The same on every rank.
  const std::string& obstacle() const { return obstacle_; }

 private:
  std::vector<std::filesystem::path> made_{};
  std::string obstacle_{};
};

}  // namespace plastron::app

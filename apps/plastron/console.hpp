// The parts that both computing programs share: reading of cases, messages, the output directory, interruptions.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/config/case.hpp>
#include <plastron/examination/examine.hpp>

#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::app {

/// The mistakes of a case file, in printed form.
struct RefusedCase : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the case with `settings` in place of some of its keys. Each process reads the case file by itself, and the
/// first one reads mesh files. If one fails, all throw RefusedCase (collective).
config::Case read_case(const std::filesystem::path& path, std::span<const std::string> settings);
/// Searches in `folder` for the files that the case names.
config::Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Returns the findings of `examination`, which must not communicate: the first rank runs it and sends them to the
/// others (collective).
std::vector<examination::Finding> examine_together(
    const std::function<std::vector<examination::Finding>()>& examination);

/// Prints a line with the title of a case, shortened, or `without` if it has no title. Units in a title are not renamed.
void print_title(const std::string& title, const std::string& without);

/// Prints the findings of an examination, with notes if requested.
void print_findings(const std::vector<examination::Finding>& findings, const std::string& case_file, bool with_notes);

/// Prints a warning of the computation on standard error.
void print_warning(const std::string& case_file, std::string_view text);

/// Logs the event of a computation's end.
void log_status(contact::Status status, std::string_view text);

/// Logs the event of a solved mesh.
void log_level(int level, const computation::Level& record);

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

/// From now on the first Ctrl-C or SIGTERM requests the computation to stop and to write the finished results. The second
/// one ends it immediately.
void listen_for_interruptions();
bool is_interrupted();

}  // namespace plastron::app

// The commands of the program. Each returns an exit code.
#pragma once
#include "exit_codes.hpp"

#include <plastron/study/kinds.hpp>

#include <filesystem>
#include <string>

namespace plastron::app {

struct RunOptions {
  std::filesystem::path case_file;
  std::filesystem::path output;
  bool quiet = false;  ///< print errors only
};

struct StudyCommand {
  std::string kind;
  std::filesystem::path case_file;
  std::filesystem::path output;
  bool quiet = false;  ///< print errors only
  study::StudyOptions options{};
};

ExitCode run(const RunOptions& options);
ExitCode study_case(const StudyCommand& command);
ExitCode check(const std::filesystem::path& case_file);

}  // namespace plastron::app

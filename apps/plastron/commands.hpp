// The commands of the program. Each returns an exit code.
#pragma once
#include "command_line.hpp"

#include <plastron/study/kinds.hpp>

#include <filesystem>
#include <string>

namespace plastron::app {

struct StudyCommand {
  std::string kind;
  std::filesystem::path case_file;
  std::filesystem::path output;
  bool quiet = false;  ///< print errors only
  int threads = 0;     ///< of each process; 0: as many as the work is worth
  study::StudyOptions options{};
};

ExitCode run(const Options& options);
ExitCode study_case(const StudyCommand& command);
ExitCode verify(const Options& options);
ExitCode check(const std::filesystem::path& case_file);

}  // namespace plastron::app

// The commands of the program. Each returns an exit code.
#pragma once
#include "exit_codes.hpp"

#include <filesystem>

namespace plastron::app {

struct RunOptions {
  std::filesystem::path case_file;
  std::filesystem::path output;
  bool quiet = false;  ///< print errors only
};

ExitCode run(const RunOptions& options);
ExitCode check(const std::filesystem::path& case_file);

}  // namespace plastron::app

// The commands that compute. Each returns an exit code.
#pragma once
#include "command_line.hpp"
#include "study_command.hpp"

#include <filesystem>

namespace plastron::app {

ExitCode run(const Options& options);
ExitCode study_case(const StudyCommand& command);
ExitCode verify(const Options& options);
ExitCode check(const Options& options);

/// Runs the command of the line; each program has its own version.
ExitCode carry_out(const CommandLine& line);

}  // namespace plastron::app

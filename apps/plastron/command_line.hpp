// The words after the program's name, of all commands but `study`, which only the solver program knows.
#pragma once
#include "exit_codes.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace plastron::app {

/// Of run, check, compare and verify; what a command does not take keeps its default.
struct Options {
  std::filesystem::path case_file;
  std::filesystem::path output;
  bool quiet = false;               ///< print errors only
  int threads = 0;                  ///< of each process; 0: as many as the work is worth
  bool without_report = false;      ///< run: no report.html
  bool solvers = false;             ///< compare: contact solvers in place of formulations
  std::filesystem::path results{};  ///< verify: the directory that run wrote to
  std::filesystem::path files{};    ///< verify: where the files are that the case names; empty: where it was run
};

inline constexpr const char* study_summary = "Solve a case many times and examine a theorem or a limit with it";

/// Sets up the program's description, version and footer.
void describe_program(CLI::App& program);
/// Declares a command that takes a case; with an output directory if `output_meaning` is given.
CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& summary,
                      const std::string& output_meaning, Options& options);
/// -q and --threads, as every command that computes takes them.
void add_computing_options(CLI::App& command, bool& quiet, int& threads);
/// Those, and -o, --output (or --out). Returns the last, which is required.
CLI::Option* add_output_options(CLI::App& command, const std::string& output_meaning, std::filesystem::path& output,
                                bool& quiet, int& threads);

/// The commands run, check, compare and verify, all filling one Options.
struct CommonCommands {
  CLI::App *run, *check, *compare, *verify;
};
CommonCommands add_common_commands(CLI::App& program, Options& options);

/// Prints the help, the version, or what is wrong with the arguments, and says how to end.
ExitCode answer(const CLI::App& program, const CLI::ParseError& reply);

}  // namespace plastron::app

// The arguments of the command line.
#pragma once
#include "exit_codes.hpp"
#include "study_command.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::app {

/// Options of run, check, compare and verify. Options that a command does not use keep their defaults.
struct Options {
  std::filesystem::path case_file;
  std::filesystem::path output;
  std::vector<std::string> settings{};  ///< settings that replace keys of the case file
  bool quiet = false;                   ///< print errors only
  int threads = 0;                      ///< for each process; 0: as many as the amount of work justifies
  bool without_report = false;          ///< run: no report.html
  bool json_log = false;                ///< events on standard error
  bool solvers = false;                 ///< compare: contact solvers instead of formulations
  std::filesystem::path results{};      ///< verify: the directory that run wrote to
  std::filesystem::path files{};        ///< verify: folder of the files that the case names; empty: folder of the run
};

/// Options of the commands that compute nothing.
struct Questions {
  std::string word{};                  ///< explain: the word; empty: all
  std::string schema = "case";         ///< schema: "case" or "results"
  std::string shell{};                 ///< completion: the shell
  std::filesystem::path name{};        ///< new: name of the case
  std::string template_name = "bowl";  ///< new: the template
  bool is_listing = false;             ///< new: only list the templates
  std::filesystem::path results{};     ///< plot: the directory that run wrote to
};

/// Sets up the program's description, version and footer.
void describe_program(CLI::App& program);
/// Declares a command that takes a case; with an output directory if `output_meaning` is given.
CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& summary,
                      const std::string& output_meaning, Options& options);
/// Adds --set for a command that reads a case.
void add_settings(CLI::App& command, std::vector<std::string>& settings);
/// Adds --json-log for a command that reports its progress.
void add_json_log(CLI::App& command, bool& json_log);
/// Adds -q and --threads for a command that computes.
void add_computing_options(CLI::App& command, bool& quiet, int& threads);
/// Adds these options, and -o, --output (or --out). Returns the last one, which is required.
CLI::Option* add_output_options(CLI::App& command, const std::string& output_meaning, std::filesystem::path& output,
                                bool& quiet, int& threads);

/// The commands run, check, compare and verify, which share one Options.
struct CommonCommands {
  CLI::App *run, *check, *compare, *verify;
};
CommonCommands add_common_commands(CLI::App& program, Options& options);

/// The commands that compute nothing. The solver program needs their names only for its help.
struct QuestionCommands {
  CLI::App *explain, *make_new, *schema, *completion, *manual, *plot;
};
QuestionCommands add_question_commands(CLI::App& program, Questions& questions);

/// The parser of all arguments of plastron, and the parsed values. It must not move, because the parser writes into it.
struct CommandLine {
  CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  CLI::App program{};
  Options options{};
  StudyCommand study_options{};
  Questions questions{};
  CommonCommands commands{};
  CLI::App* study = nullptr;
  QuestionCommands asked{};
};

/// Starts the event log if it is requested.
void log_start(const CommandLine& line);

/// Prints the help, the version, or the error in the arguments, and returns the exit code.
ExitCode answer(const CLI::App& program, const CLI::ParseError& reply);

}  // namespace plastron::app

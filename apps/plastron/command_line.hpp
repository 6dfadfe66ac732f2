// The words after the program's name.
#pragma once
#include "exit_codes.hpp"
#include "study_command.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::app {

/// Of run, check, compare and verify; what a command does not take keeps its default.
struct Options {
  std::filesystem::path case_file;
  std::filesystem::path output;
  std::vector<std::string> settings{};  ///< that take the place of keys of the case file
  bool quiet = false;                   ///< print errors only
  int threads = 0;                      ///< of each process; 0: as many as the work is worth
  bool without_report = false;          ///< run: no report.html
  bool json_log = false;                ///< events on standard error
  bool solvers = false;                 ///< compare: contact solvers in place of formulations
  std::filesystem::path results{};      ///< verify: the directory that run wrote to
  std::filesystem::path files{};        ///< verify: where the files are that the case names; empty: where it was run
};

/// Of the commands that compute nothing.
struct Questions {
  std::string word{};                  ///< explain: what is asked for; empty: all
  std::string schema = "case";         ///< schema: of what
  std::string shell{};                 ///< completion: for which
  std::filesystem::path name{};        ///< new: of the case
  std::string template_name = "bowl";  ///< new: what it begins as
  bool is_listing = false;             ///< new: tell the templates only
  std::filesystem::path results{};     ///< plot: the directory that run wrote to
};

/// Sets up the program's description, version and footer.
void describe_program(CLI::App& program);
/// Declares a command that takes a case; with an output directory if `output_meaning` is given.
CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& summary,
                      const std::string& output_meaning, Options& options);
/// --set, as every command that reads a case takes it.
void add_settings(CLI::App& command, std::vector<std::string>& settings);
/// --json-log, as every command takes it that tells what it does.
void add_json_log(CLI::App& command, bool& json_log);
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

/// The commands that compute nothing; the solver program knows their names only for its help.
struct QuestionCommands {
  CLI::App *explain, *make_new, *schema, *completion, *manual, *plot;
};
QuestionCommands add_question_commands(CLI::App& program, Questions& questions);

/// All that may be said to plastron, and what was said. Stays where it is: the parser writes into it.
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

/// Begins the log of events if it is asked for.
void log_start(const CommandLine& line);

/// Prints the help, the version, or what is wrong with the arguments, and says how to end.
ExitCode answer(const CLI::App& program, const CLI::ParseError& reply);

}  // namespace plastron::app

// The command line: its arguments, its commands and their exit codes (docs/command-line.md).
#pragma once
#include <plastron/contact/problem.hpp>
#include <research/names/study_names.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::app {

enum ExitCode : int { solved = 0, bad_input = 2, not_converged = 3, not_verified = 3, internal_error = 4 };

constexpr ExitCode exit_code(contact::Status status) {
  switch (status) {
    case contact::Status::solved:
      return solved;
    case contact::Status::infeasible:
      return bad_input;
    default:
      return not_converged;
  }
}

/// Options of run, modes, check, compare and verify. Options that a command does not use keep their defaults.
struct Options {
  std::filesystem::path case_file;
  std::filesystem::path output;
  std::vector<std::string> settings{};  ///< settings that replace keys of the case file
  bool quiet = false;                   ///< print errors and warnings only
  int threads = 0;                      ///< for each process; 0: as many as the amount of work justifies
  int buckling = -1;                    ///< modes: number of buckling loads; -1: the case's, or 6
  int vibration = -1;                   ///< modes: number of natural frequencies, likewise
  bool without_report = false;          ///< run: no report.html
  bool json_log = false;                ///< events on standard error
  bool solvers = false;                 ///< compare: contact solvers instead of formulations
  std::filesystem::path results{};      ///< verify: the directory that run wrote to
  std::filesystem::path files{};        ///< verify: folder of the files that the case names; empty: folder of the run
};

/// Options of study: one table of kinds, and options for some of them.
struct StudyCommand {
  std::string kind;
  std::filesystem::path case_file;
  std::filesystem::path output;
  std::vector<std::string> settings{};  ///< settings that replace keys of the case file
  bool quiet = false;                   ///< print errors and warnings only
  int threads = 0;                      ///< for each process; 0: as many as the amount of work justifies
  bool json_log = false;                ///< events on standard error
  study::StudyOptions options{};
};

/// Options of sweep.
struct SweepOptions {
  std::filesystem::path case_file;
  std::filesystem::path output;
  std::filesystem::path table{};        ///< empty: table.csv in `output`
  std::vector<std::string> settings{};  ///< keys with their values, separated by commas
  int jobs = 1;                         ///< cases that are solved at a time
  bool with_reports = false;            ///< whether each case has a report.html
  bool quiet = false;                   ///< print errors and warnings only
};

/// Options of the commands that compute nothing.
struct Questions {
  std::string word{};               ///< explain: the word; empty: all
  std::string schema = "case";      ///< schema: "case" or "results"
  std::string shell{};              ///< completion: the shell
  std::filesystem::path name{};     ///< new: name of the case
  std::string example = "bowl";     ///< new: the template or the case of the gallery
  bool is_listing = false;          ///< new: only list them
  std::filesystem::path results{};  ///< plot: the directory that run wrote to
};

/// Options of parts.
struct PartsOptions {
  std::string file{};  ///< a mesh in space
  double scale = 1;    ///< factor of its lengths
  double size = 0;     ///< sides of cells from facets [m]; 0: from the area
  double smooth = 0;   ///< largest angle of smooth edges [degrees]; 0: the default of its order
  std::string page{};  ///< HTML file to write; empty: none
};

/// The commands run, modes, check, compare and verify, which share one Options.
struct CommonCommands {
  CLI::App *run, *modes, *check, *compare, *verify;
};

/// The commands that compute nothing. The solver program needs their names only for its help.
struct QuestionCommands {
  CLI::App *explain, *make_new, *schema, *completion, *manual, *plot;
};

/// The parser of all arguments of plastron, and the parsed values. It must not move, because the parser writes into it.
struct CommandLine {
  CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  CLI::App program{};
  Options options{};
  StudyCommand study_options{};
  PartsOptions parts_options{};
  SweepOptions sweep_options{};
  Questions questions{};
  CommonCommands commands{};
  CLI::App *study = nullptr, *parts = nullptr, *sweep = nullptr;
  QuestionCommands asked{};
};

/// Starts the event log if it is requested.
void log_start(const CommandLine& line);

/// Prints the help, the version, or the error in the arguments, and returns the exit code.
ExitCode answer(const CLI::App& program, const CLI::ParseError& reply);

// The commands that compute.

ExitCode run(const Options& options);
ExitCode study_case(const StudyCommand& command);
ExitCode verify(const Options& options);
ExitCode parts(const PartsOptions& options);
ExitCode check(const Options& options);

/// Runs the command of the line; each program has its own version.
ExitCode carry_out(const CommandLine& line);

/// Solves a case for all combinations of values, in processes of its own. Throws CLI::ParseError, config::CaseErrors.
ExitCode sweep(const SweepOptions& options);

/// Returns the program beside this one, or in the folder of packages for programs that users do not start.
std::filesystem::path find_program(const char* name);

// The commands that compute nothing: `plastron` runs them itself, without the solver.

/// Prints the manual for a word; an overview without a word.
ExitCode explain(const std::string& word);
/// Returns the words that explain() knows in full, for completion.
std::vector<std::string> explained_words();

/// Writes the example as NAME.toml or NAME/case.toml, with the files that it names, or lists the examples.
ExitCode new_case(const std::filesystem::path& name, const std::string& example, bool is_listing);
/// Returns the names of the templates, then those of the cases of the gallery.
std::vector<std::string> example_names();

/// Prints the completion for "bash", "zsh" or "fish".
ExitCode print_completion(const CLI::App& program, const std::string& shell);
ExitCode print_manual_page(const CLI::App& program);

/// Writes plot-*.svg of the results in a directory into this directory.
ExitCode plot(const std::filesystem::path& directory);

}  // namespace plastron::app

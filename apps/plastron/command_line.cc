#include "command_line.hpp"

#include "terminal.hpp"

#include <plastron/io/version.hpp>

#include <sstream>

namespace plastron::app {

void describe_program(CLI::App& program) {
  program.description("Plastron computes thin elastic shells (Naghdi's model) pressed on a rigid obstacle.");
  program.set_version_flag("--version", std::string(io::version));
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 solved or verified, 2 bad input, 3 not converged, interrupted or not verified, 4 internal error.");
}

void add_computing_options(CLI::App& command, bool& quiet, int& threads) {
  command.add_flag("-q,--quiet", quiet, "Print errors only");
  command.add_option("--threads", threads, "Threads of each process; 0: as many as the work is worth")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

CLI::Option* add_output_options(CLI::App& command, const std::string& output_meaning, std::filesystem::path& output,
                                bool& quiet, int& threads) {
  CLI::Option* option = command.add_option("-o,--output,--out", output, output_meaning)->required();
  add_computing_options(command, quiet, threads);
  return option;
}

CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& summary,
                      const std::string& output_meaning, Options& options) {
  CLI::App* command = program.add_subcommand(name, summary);
  command->add_option("CASE", options.case_file, "Case file (TOML)")->required();
  if (!output_meaning.empty())
    add_output_options(*command, output_meaning, options.output, options.quiet, options.threads);
  return command;
}

namespace {

/// `compare` sets formulations side by side, or with --solvers contact solvers; these also without files.
CLI::App* add_compare(CLI::App& program, Options& options) {
  CLI::App* compare =
      add_command(program, "compare", "Solve a case in every formulation and set them side by side", "", options);
  CLI::Option* output =
      add_output_options(*compare, "Directory for compare.json and compare.svg; not required with --solvers",
                         options.output, options.quiet, options.threads)
          ->required(false);
  compare->add_flag("--solvers", options.solvers,
                    "Set all contact solvers side by side, in the case's own formulation (compare-solvers.json)");
  compare->callback([output, &options] {
    if (!options.solvers && output->empty()) throw CLI::RequiredError("--output");
  });
  return compare;
}

CLI::App* add_run(CLI::App& program, Options& options) {
  CLI::App* run = add_command(program, "run", "Solve a case and write its results",
                              "Directory for results.json, report.html and the .vtu files", options);
  run->add_flag("--no-report", options.without_report, "Write no report.html");
  return run;
}

/// `verify` takes results, not a case.
CLI::App* add_verify(CLI::App& program, Options& options) {
  CLI::App* verify = program.add_subcommand(
      "verify", "Recompute the certificate of written results from the case alone: PASSED, or what fails");
  verify->add_option("DIR", options.results, "Directory that plastron run wrote to")->required();
  verify->add_option("--files", options.files,
                     "Folder of the meshes and other files that the case names, if not where the case was run");
  add_computing_options(*verify, options.quiet, options.threads);
  return verify;
}

}  // namespace

CommonCommands add_common_commands(CLI::App& program, Options& options) {
  return {
      .run = add_run(program, options),
      .check = add_command(program, "check", "Examine a case without solving it", "", options),
      .compare = add_compare(program, options),
      .verify = add_verify(program, options),
  };
}

namespace {

/// The first word, where it should be a command and is none; empty otherwise.
std::string unknown_command(const CLI::App& program) {
  const auto rest = program.remaining();
  return program.get_subcommands().empty() && !rest.empty() ? rest.front() : std::string();
}

}  // namespace

ExitCode answer(const CLI::App& program, const CLI::ParseError& reply) {
  std::ostringstream out, err;
  const bool good = program.exit(reply, out, err) == 0;
  if (const std::string word = unknown_command(program); !good && !word.empty()) {
    print_error(
        "there is no command \"{}\"; the commands are run, check, compare, verify, study; plastron --help tells more\n",
        word);
  } else if (is_first_rank()) {
    print_text(stdout, out.str());
    print_text(stderr, err.str());
  }
  return good ? solved : bad_input;
}

}  // namespace plastron::app

#include "command_line.hpp"

#include "terminal.hpp"

#include <plastron/config/nearest.hpp>
#include <plastron/io/results.hpp>
#include <research/names/study_names.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <sstream>
#include <thread>

namespace plastron::app {

namespace {

/// Sets up the description, version and footer of the program.
void describe_program(CLI::App& program) {
  program.description("Plastron computes thin elastic shells (Naghdi's model) pressed on a rigid obstacle.");
  program.set_version_flag("--version", std::string(io::version));
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 solved or verified, 2 bad input, 3 not converged, interrupted or not verified, 4 internal error.");
}

/// Adds --set for a command that reads a case.
void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option(
          "--set", settings,
          "Value of a key, instead of the one in the case, in TOML: shell.thickness=0.02, 'obstacle[0].force=[0,0,-2]'")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

/// Adds --json-log for a command that reports its progress.
void add_json_log(CLI::App& command, bool& json_log) {
  command.add_flag("--json-log", json_log, "Write events to standard error, one JSON object per line");
}

/// Adds -q and --threads for a command that computes.
void add_computing_options(CLI::App& command, bool& quiet, int& threads) {
  command.add_flag("-q,--quiet", quiet, "Print errors and warnings only");
  command.add_option("--threads", threads, "Threads of each process; 0: as many as the amount of work justifies")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

/// Adds these options, and -o, --output (or --out). Returns the last one, which is required.
CLI::Option* add_output_options(CLI::App& command, const std::string& output_meaning, std::filesystem::path& output,
                                bool& quiet, int& threads) {
  CLI::Option* option = command.add_option("-o,--output,--out", output, output_meaning)->required();
  add_computing_options(command, quiet, threads);
  return option;
}

/// Declares a command that takes a case; with an output directory if `output_meaning` is given.
CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& summary,
                      const std::string& output_meaning, Options& options) {
  CLI::App* command = program.add_subcommand(name, summary);
  command->add_option("CASE", options.case_file, "Case file (TOML)")->required();
  add_settings(*command, options.settings);
  add_json_log(*command, options.json_log);
  if (!output_meaning.empty())
    add_output_options(*command, output_meaning, options.output, options.quiet, options.threads);
  return command;
}

/// `compare` compares formulations, or with --solvers contact solvers; the latter also without files.
CLI::App* add_compare(CLI::App& program, Options& options) {
  CLI::App* compare =
      add_command(program, "compare", "Solve a case in every formulation and compare the results", "", options);
  CLI::Option* output =
      add_output_options(*compare, "Directory for compare.json and compare.svg; not required with --solvers",
                         options.output, options.quiet, options.threads)
          ->required(false);
  compare->add_flag("--solvers", options.solvers,
                    "Compare all contact solvers in the formulation of the case instead (compare-solvers.json)");
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

CLI::App* add_modes(CLI::App& program, Options& options) {
  CLI::App* modes =
      add_command(program, "modes", "Solve a case, and compute its buckling loads and natural frequencies",
                  "Directory for results.json, report.html and the .vtu files", options);
  modes->add_flag("--no-report", options.without_report, "Write no report.html");
  modes->add_option("--buckling", options.buckling, "Number of buckling loads; default: the case's, or 6")
      ->check(CLI::Range(0, 200));
  modes
      ->add_option("--vibration", options.vibration,
                   "Number of natural frequencies; default: the case's, or 6 if the shell has a density")
      ->check(CLI::Range(0, 200));
  return modes;
}

/// `verify` takes results, not a case.
CLI::App* add_verify(CLI::App& program, Options& options) {
  CLI::App* verify = program.add_subcommand(
      "verify", "Recompute the certificate of written results from the case and print PASSED, or what fails");
  verify->add_option("DIR", options.results, "Directory that plastron run wrote to")->required();
  verify->add_option("--files", options.files,
                     "Folder of meshes and other files that the case names; default: where the case was run");
  add_computing_options(*verify, options.quiet, options.threads);
  add_json_log(*verify, options.json_log);
  return verify;
}

CommonCommands add_common_commands(CLI::App& program, Options& options) {
  return {
      .run = add_run(program, options),
      .modes = add_modes(program, options),
      .check = add_command(program, "check", "Examine a case without solving it", "", options),
      .compare = add_compare(program, options),
      .verify = add_verify(program, options),
  };
}

/// Checks combinations of a study's options.
void check_study_options(const CLI::App& app, const study::KindName& kind, const std::vector<double>& factors) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_single_name(), takers = study::kinds_that_take(name);
    if (option->count() > 0 && !takers.empty() && !study::takes_option(kind, name))
      throw CLI::ValidationError("--" + name, fmt::format("{} does not take it; it is for: {}", kind.name, takers));
  }
  if (std::ranges::adjacent_find(factors, std::less_equal<>{}) != factors.end())
    throw CLI::ValidationError("--factors", "must decrease from one to the next");
}

/// Adds options that only some kinds have. Returns the number of halvings.
std::shared_ptr<int> add_options_of_kinds(CLI::App& app, study::StudyOptions& o) {
  const auto add = [&app](const std::string& name, auto& value, const std::string& what) {
    return app.add_option("--" + name, value, study::kinds_that_take(name) + ": " + what);
  };
  add("reference", o.reference, "levels between the finest mesh and the reference")
      ->check(CLI::Range(1, 6))
      ->capture_default_str();
  CLI::Option* factors = add("factors", o.factors, "multiples of the case's thickness, from thick to thin")
                             ->delimiter(',')
                             ->check(CLI::PositiveNumber);
  auto steps = std::make_shared<int>(0);
  add("steps", *steps, "number of halvings, instead of --factors")->check(CLI::Range(1, 20))->excludes(factors);
  add("load-exponent", o.load_exponent, "P: loads are multiplied by factor^P; default 0, with obstacle 3");
  add("samples", o.samples, "perturbations of each kind")->check(CLI::Range(1, 100000))->capture_default_str();
  add("size", o.size, "largest relative perturbation")->check(CLI::Range(1e-6, 0.5))->capture_default_str();
  add("seed", o.seed, "seed of the random numbers")->capture_default_str();
  return steps;
}

CLI::App* add_study(CLI::App& program, StudyCommand& command) {
  std::vector<std::string> names;
  std::string footer = "Kinds:\n";
  for (const study::KindName& kind : study::kind_names()) {
    names.emplace_back(kind.name);
    footer += fmt::format("  {:<12} {}\n", kind.name, kind.question);
  }
  CLI::App* app = program.add_subcommand("study", "Solve a case many times to examine a theorem or a limit");
  app->footer(footer);
  app->add_option("KIND", command.kind, "What to examine; see below")->required()->check(CLI::IsMember(names));
  app->add_option("CASE", command.case_file, "Case file (TOML)")->required();
  add_settings(*app, command.settings);
  add_json_log(*app, command.json_log);
  add_output_options(*app, "Directory for KIND.json and KIND.svg", command.output, command.quiet, command.threads);
  const auto steps = add_options_of_kinds(*app, command.options);
  app->callback([app, &command, steps] {
    if (*steps > 0)
      for (int i = 0; i <= *steps; ++i) command.options.factors.push_back(std::ldexp(1.0, -i));
    check_study_options(*app, *study::find_kind_name(command.kind), command.options.factors);
  });
  return app;
}

CLI::App* add_parts(CLI::App& program, PartsOptions& options) {
  CLI::App* parts = program.add_subcommand(
      "parts", "List the regions, curves and folds of a mesh in space, and what is doubtful in it");
  parts
      ->add_option("MESH", options.file,
                   "CAD file (.step, .brep), mesh in space (.msh, .inp) or facets (.stl, .obj, .ply)")
      ->required();
  parts->add_option("--scale", options.scale, "Factor of its lengths: 1e-3 for millimetres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  parts
      ->add_option("--size", options.size,
                   "Sides of the cells that are made on CAD faces or from facets, in scaled lengths")
      ->check(CLI::PositiveNumber);
  parts->add_option("--smooth", options.smooth, "Largest angle of smooth edges in degrees")
      ->check(CLI::Range(0.0, 170.0));
  parts->add_option("--page", options.page, "File to write: the mesh to turn round, and these tables (.html)");
  return parts;
}

CLI::App* add_sweep(CLI::App& program, SweepOptions& options) {
  CLI::App* sweep = program.add_subcommand(
      "sweep",
      "Solve a case for all combinations of values, several at a time, and write one table; solved cases are kept");
  sweep->add_option("CASE", options.case_file, "Case file (TOML)")->required();
  sweep
      ->add_option("--set", options.settings,
                   "Values of a key, in TOML: shell.thickness=0.01,0.02. Each further --set multiplies the cases")
      ->type_name("KEY=VALUE,...")
      ->required()
      ->allow_extra_args(false);
  sweep->add_option("-o,--output,--out", options.output, "Directory with a folder 0001, 0002, ... for each case")
      ->required();
  sweep->add_option("--table", options.table, "File of the table (.csv); default: table.csv in the directory");
  options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  sweep->add_option("-j,--jobs", options.jobs, "Cases that are solved at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  sweep->add_flag("--reports", options.with_reports, "Write report.html for each case");
  sweep->add_flag("-q,--quiet", options.quiet, "Print errors and warnings only");
  return sweep;
}

QuestionCommands add_question_commands(CLI::App& program, Questions& questions) {
  CLI::App* explain = program.add_subcommand(
      "explain", "Explain a key of the case file, a field, a number, a status or a limit of the program");
  explain->add_option("WORD", questions.word, "shell.thickness, obstacle.ball, eta, contact.area, not_held, ...");
  CLI::App* make_new = program.add_subcommand("new", "Write a case to start from; existing files are not overwritten");
  CLI::Option* name = make_new->add_option("NAME", questions.name, "Directory for case.toml, or a file NAME.toml");
  CLI::Option* from = make_new
                          ->add_option("--from", questions.example,
                                       "Commented template, or case of the gallery with its meshes, see --list")
                          ->capture_default_str();
  CLI::Option* former = make_new->add_option("-t,--template", questions.example)->group("");  // not in the help
  make_new->add_flag("-l,--list", questions.is_listing, "List templates and cases of the gallery");
  make_new->callback([name, from, former, &questions] {
    if (from->count() > 0 && former->count() > 0) throw CLI::ExcludesError("--from", "--template");
    if (!questions.is_listing && name->empty()) throw CLI::RequiredError("NAME");
  });
  CLI::App* schema = program.add_subcommand("schema", "Print the JSON Schema of the case file or of results.json");
  schema->add_option("OF", questions.schema, "case or results")
      ->check(CLI::IsMember({"case", "results"}))
      ->capture_default_str();
  CLI::App* completion =
      program.add_subcommand("completion", "Print a script by which a shell completes this command line");
  completion->add_option("SHELL", questions.shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  CLI::App* manual = program.add_subcommand("man", "Print the manual page: plastron man | man -l -");
  CLI::App* plot = program.add_subcommand(
      "plot", "Draw written results as SVG: convergence and contact by mesh, profiles along lines, histories of steps");
  plot->add_option("DIR", questions.results, "Directory that plastron run wrote to; plot-*.svg are written there")
      ->required();
  return {.explain = explain,
          .make_new = make_new,
          .schema = schema,
          .completion = completion,
          .manual = manual,
          .plot = plot};
}

}  // namespace

CommandLine::CommandLine() {
  describe_program(program);
  commands = add_common_commands(program, options);
  study = add_study(program, study_options);
  parts = add_parts(program, parts_options);
  sweep = add_sweep(program, sweep_options);
  asked = add_question_commands(program, questions);
}

void log_start(const CommandLine& line) {
  const auto chosen = line.program.get_subcommands();
  if (line.parts->parsed()) return;
  const bool is_study = line.study->parsed(), is_verify = line.commands.verify->parsed();
  if (!(is_study ? line.study_options.json_log : line.options.json_log)) return;
  log_events();
  const auto& of = is_study ? line.study_options.case_file : is_verify ? line.options.results : line.options.case_file;
  log_event("start", {{"command", chosen.empty() ? "" : chosen.front()->get_name()},
                      {is_verify ? "directory" : "case", of.string()},
                      {"version", io::version}});
}

namespace {

/// Returns the first word if it should be a command and is none; empty otherwise.
std::string unknown_command(const CLI::App& program) {
  const auto rest = program.remaining();
  return program.get_subcommands().empty() && !rest.empty() ? rest.front() : std::string();
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

}  // namespace

ExitCode answer(const CLI::App& program, const CLI::ParseError& reply) {
  std::ostringstream out, err;
  const bool good = program.exit(reply, out, err) == 0;
  if (const std::string word = unknown_command(program); !good && !word.empty()) {
    const auto known = command_names(program);
    const std::string meant = config::did_you_mean(word, known);
    print_error("there is no command \"{}\"; {}the commands are {}; see plastron --help\n", word,
                meant.empty() ? "" : meant + " ", fmt::join(known, ", "));
  } else if (is_first_rank()) {
    print_text(stdout, out.str());
    print_text(stderr, err.str());
  }
  return good ? solved : bad_input;
}

}  // namespace plastron::app

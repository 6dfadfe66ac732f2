#include "command_line.hpp"
#include "console.hpp"
#include "progress.hpp"
#include "terminal.hpp"

#include <plastron/workflow/output_directory.hpp>
#include <plastron/workflow/read.hpp>
#include <plastron/workflow/solve.hpp>

#include <mpi.h>

namespace plastron::app {

namespace {

std::vector<examination::Finding> examine(const config::Case& c) {
  return workflow::examine_together([&] { return examination::examine(c.problem); }, MPI_COMM_WORLD);
}

}  // namespace

ExitCode check(const Options& options) {
  const config::Case c = read_case(options.case_file, options.settings);
  const std::string case_file = options.case_file.string();
  print("{}: ", case_file);
  print_title(c.title, "untitled");
  const auto findings = examine(c);
  print_findings(findings, case_file, true);
  if (examination::has_errors(findings)) return bad_input;
  print("  ready to run\n");
  return solved;
}

namespace {

/// Writes the results and reports them.
void report(const computation::Result& result, const config::Case& c, io::CaseSource source, const Options& options,
            workflow::Output& files) {
  const auto names = files.finish(result, workflow::provenance_of(c, std::move(source)), c.problem.lines);
  for (const std::string& name : names) log_event("file", {{"path", (options.output / name).string()}});
  if (options.quiet) return;
  print_summary(result);
  print("\nresults           {}\n", (options.output / "results.json").string());
}

}  // namespace

ExitCode run(const Options& options) {
  const std::string case_file = options.case_file.string();
  const config::Case c = read_case(options.case_file, options.settings);
  const auto findings = examine(c);
  print_findings(findings, case_file, false);
  if (examination::has_errors(findings)) return bad_input;
  const workflow::OutputDirectory output(options.output, workflow::inputs_of(c, options.case_file), MPI_COMM_WORLD);
  if (!output.obstacle().empty()) {
    print_error("{}: error: results cannot be written here: {}\n", options.output.string(), output.obstacle());
    return bad_input;
  }

  if (!options.quiet) {
    print_title(c.title, case_file);
    print("\n");
  }
  io::CaseSource source = workflow::source_of(c, options.case_file, options.settings, MPI_COMM_WORLD);
  Progress progress(c.problem, options.quiet);
  computation::Observer observer = progress.observer();
  observer.warning = [&](std::string_view text) {
    progress.finish();
    print_warning(case_file, text);
  };
  const bool with_report = c.wants_report && !options.without_report;
  workflow::Output files(options.output, workflow::base_name, MPI_COMM_WORLD, with_report, c.problem.output);
  observer.instant = [&](const computation::HistoryEntry& entry, const computation::Solution&) {
    progress.instant(entry);
  };
  const computation::Result result = workflow::solve(c, findings, files, MPI_COMM_WORLD, observer);
  progress.finish();
  if (workflow::is_refused(result.status)) {
    log_status(result.status, contact::explain(result.status));
    print_error("{}: error: {}\n", case_file, workflow::refusal(result));
    return bad_input;
  }
  if (result.levels.empty()) {
    log_status(result.status, "interrupted before the first mesh was finished: no results");
    print_error("{}: interrupted before the first mesh was finished: no results\n", case_file);
    return not_converged;
  }
  report(result, c, std::move(source), options, files);
  if (with_report && !options.quiet) print("report            {}\n", (options.output / "report.html").string());
  log_status(result.status, computation::status_text(result));
  if (result.status == contact::Status::interrupted)
    print_error("{}: interrupted: {}\n", case_file, computation::status_text(result));
  else if (result.status != contact::Status::solved)
    print_error("{}: not converged: {}\n", case_file, computation::status_text(result));
  return exit_code(result.status);
}

/// Returns the options of `run` with settings for the modes that the command asks for.
Options with_modes(Options options) {
  const problem::Problem problem = read_case(options.case_file, options.settings).problem;
  const bool asks_for_none = problem.modes.buckling == 0 && problem.modes.vibration == 0;
  const auto set = [&](const char* key, int asked, bool is_possible) {
    if (asked < 0 && !(asks_for_none && is_possible)) return;
    constexpr int usual = 6;
    options.settings.push_back(fmt::format("modes.{}={}", key, asked < 0 ? usual : asked));
  };
  set("buckling", options.buckling, true);
  set("vibration", options.vibration, problem.shell.sections.has_mass());
  return options;
}

ExitCode carry_out(const CommandLine& line) {
  if (line.parts->parsed()) return parts(line.parts_options);
  if (line.commands.verify->parsed()) return verify(line.options);
  if (line.commands.modes->parsed()) return run(with_modes(line.options));
  return line.commands.run->parsed() ? run(line.options) : check(line.options);
}

}  // namespace plastron::app

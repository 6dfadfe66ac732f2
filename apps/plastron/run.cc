#include "command_line.hpp"
#include "console.hpp"
#include "progress.hpp"
#include "terminal.hpp"

#include <plastron/algebra/agreement.hpp>
#include <plastron/io/output.hpp>

#include <mpi.h>

#include <algorithm>

namespace plastron::app {

ExitCode check(const Options& options) {
  const config::Case c = read_case(options.case_file, options.settings);
  const std::string case_file = options.case_file.string();
  print("{}: ", case_file);
  print_title(c.title, "untitled");
  const auto findings = examine_together([&] { return examination::examine(c.problem); });
  print_findings(findings, case_file, true);
  if (examination::has_errors(findings)) return bad_input;
  print("  ready to run\n");
  return solved;
}

namespace {

/// Adds the warnings of the examination to the result.
void add_warnings(const std::vector<examination::Finding>& findings, std::vector<std::string>& warnings) {
  for (const examination::Finding& finding : findings)
    if (finding.severity == examination::Severity::warning && std::ranges::count(warnings, finding.text) == 0)
      warnings.push_back(finding.text);
}

/// Returns the case file and the files that it names, before anything is solved. Each rank reads the same files.
io::CaseSource source_of(const config::Case& c, const Options& options) {
  auto source =
      algebra::in_agreement(MPI_COMM_WORLD, [&] { return io::case_source(options.case_file, c.text, c.files); });
  source.settings = options.settings;
  return source;
}

/// Returns the paths of the case file and of the files that it names.
std::vector<std::filesystem::path> inputs_of(const config::Case& c, const Options& options) {
  std::vector<std::filesystem::path> inputs{options.case_file};
  for (const auto& [name, path] : c.files) inputs.push_back(path);
  return inputs;
}

/// Writes the results and reports them.
void report(const computation::Result& result, const config::Case& c, io::CaseSource source, const Options& options,
            io::Output& files) {
  const auto names = files.finish(
      result, {.title = c.title, .settings = c.effective, .files = {}, .source = std::move(source)}, c.problem.lines);
  for (const std::string& name : names) log_event("file", {{"path", (options.output / name).string()}});
  if (options.quiet) return;
  print_summary(result);
  print("\nresults           {}\n", (options.output / "results.json").string());
}

}  // namespace

ExitCode run(const Options& options) {
  const std::string case_file = options.case_file.string();
  const config::Case c = read_case(options.case_file, options.settings);
  const auto findings = examine_together([&] { return examination::examine(c.problem); });
  print_findings(findings, case_file, false);
  if (examination::has_errors(findings)) return bad_input;
  const OutputDirectory output(options.output, inputs_of(c, options));
  if (!output.obstacle().empty()) {
    print_error("{}: error: results cannot be written here: {}\n", options.output.string(), output.obstacle());
    return bad_input;
  }

  if (!options.quiet) {
    print_title(c.title, case_file);
    print("\n");
  }
  io::CaseSource source = source_of(c, options);
  Progress progress(c.problem, options.quiet);
  computation::Observer observer = progress.observer();
  observer.warning = [&](std::string_view text) {
    progress.finish();
    print_warning(case_file, text);
  };
  const bool with_report = c.wants_report && !options.without_report;
  io::Output files(options.output, base_name, MPI_COMM_WORLD, with_report, c.problem.output);
  observer.instant = [&](const computation::HistoryEntry& entry, const computation::Solution& solution) {
    progress.instant(entry);
    files.add_instant(entry, solution);
  };
  computation::Result result = computation::solve(c.problem, MPI_COMM_WORLD, observer);
  progress.finish();
  add_warnings(findings, result.warnings);
  if (exit_code(result.status) == bad_input) {
    const std::string where =
        result.history.empty()
            ? ""
            : fmt::format("in step \"{}\", at time {:g}: ", result.history.back().step, result.history.back().time);
    log_status(result.status, contact::explain(result.status));
    print_error("{}: error: {}{}\n", case_file, where, contact::explain(result.status));
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
  const config::Case c = read_case(options.case_file, options.settings);
  const bool asks_for_none = c.problem.modes.buckling == 0 && c.problem.modes.vibration == 0;
  const auto set = [&](const char* key, int asked, bool is_possible) {
    if (asked < 0 && !(asks_for_none && is_possible)) return;
    constexpr int usual = 6;
    options.settings.push_back(fmt::format("modes.{}={}", key, asked < 0 ? usual : asked));
  };
  set("buckling", options.buckling, true);
  set("vibration", options.vibration, c.problem.shell.sections.has_mass());
  return options;
}

ExitCode carry_out(const CommandLine& line) {
  if (line.parts->parsed()) return parts(line.parts_options);
  if (line.commands.verify->parsed()) return verify(line.options);
  if (line.commands.modes->parsed()) return run(with_modes(line.options));
  return line.commands.run->parsed() ? run(line.options) : check(line.options);
}

}  // namespace plastron::app

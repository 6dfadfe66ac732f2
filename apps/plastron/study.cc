#include "commands.hpp"
#include "outcome.hpp"
#include "progress.hpp"
#include "reading.hpp"

#include <plastron/io/study_report.hpp>

#include <mpi.h>

#include <optional>
#include <string>

namespace plastron::app {

namespace {

/// A study of that name, or one of the comparisons that are commands of their own.
const study::Kind& kind_of(const std::string& name) {
  const study::Kind* kind = study::find_kind(name);
  if (kind != nullptr) return *kind;
  return name == study::solver_comparison().name ? study::solver_comparison() : study::comparison();
}

void print_report(const study::Report& report, const config::Case& c, const StudyCommand& command) {
  print("{}\n", c.title.empty() ? command.case_file.string() : shortened_title(c.title));
  if (is_first_rank()) print_text(stdout, io::table_text(report.table));
  if (command.output.empty()) return;
  print("\nresults           {}\n", (command.output / (report.table.name + ".json")).string());
  if (!report.table.rows.empty())
    print("plot              {}\n", (command.output / (report.table.name + ".svg")).string());
}

}  // namespace

ExitCode study_case(const StudyCommand& command) {
  const config::Case c = read_case(command.case_file);
  const study::Kind& kind = kind_of(command.kind);
  const auto findings = examine_together([&] { return study::examine(kind, c.problem, command.options); });
  print_findings(findings, command.case_file.string(), false);
  if (examination::has_errors(findings)) return bad_input;
  std::optional<OutputDirectory> output;
  if (!command.output.empty()) output.emplace(command.output);
  if (output && !output->obstacle().empty()) {
    print_error("{}: error: results cannot be written here: {}\n", command.output.string(), output->obstacle());
    return bad_input;
  }

  StageProgress progress(command.quiet);
  const study::Report report = kind.run(c.problem, command.options, MPI_COMM_WORLD, progress.observer());
  progress.finish();
  if (exit_code(report.status) == bad_input) {
    print_error("{}: error: {}\n", command.case_file.string(), contact::explain(report.status));
    return bad_input;
  }
  if (output)
    io::write_report(report, {.title = c.title, .settings = c.effective, .files = {}}, command.output, MPI_COMM_WORLD);
  if (!command.quiet) print_report(report, c, command);
  if (report.status != contact::Status::solved)
    print_error("{}: {}: {}\n", command.case_file.string(),
                report.status == contact::Status::interrupted ? "interrupted" : "not converged",
                contact::explain(report.status));
  return exit_code(report.status);
}

}  // namespace plastron::app

#include "commands.hpp"
#include "console.hpp"
#include "outcome.hpp"

#include <plastron/config/case.hpp>
#include <plastron/io/output.hpp>

#include <mpi.h>

#include <algorithm>

namespace plastron::app {

namespace {

/// The warnings that the examination has not given already.
void print_new_warnings(const std::vector<std::string>& warnings, const std::vector<study::Finding>& findings,
                        const std::string& case_file) {
  for (const std::string& warning : warnings)
    if (std::ranges::find(findings, warning, &study::Finding::text) == findings.end())
      print_error("{}: warning: {}\n", case_file, warning);
}

}  // namespace

ExitCode run(const RunOptions& options) {
  const config::Case c = config::read_case(options.case_file);
  const auto findings = study::examine(c.problem);
  print_findings(findings, options.case_file.string(), false);
  if (study::has_errors(findings)) return bad_input;
  if (const std::string reason = obstacle_to_writing(options.output); !reason.empty()) {
    print_error("{}: error: results cannot be written here: {}\n", options.output.string(), reason);
    return bad_input;
  }

  if (!options.quiet) print("{}\n\n", c.title.empty() ? options.case_file.string() : c.title);
  Progress progress(c.problem.obstacle.has_value(), options.quiet);
  const study::Result result = study::solve(c.problem, MPI_COMM_WORLD, progress.observer());
  print_new_warnings(result.warnings, findings, options.case_file.string());
  if (exit_code(result.status) == bad_input) {
    print_error("{}: error: {}\n", options.case_file.string(), contact::explain(result.status));
    return bad_input;
  }
  io::write_output(result, {.title = c.title, .settings = c.effective, .files = {}}, options.output, "solution",
                   MPI_COMM_WORLD);
  if (!options.quiet) {
    print_summary(result);
    print("\nresults           {}\n", (options.output / "results.json").string());
  }
  if (result.status != contact::Status::solved)
    print_error("{}: not converged: {}\n", options.case_file.string(), study::status_text(result));
  return exit_code(result.status);
}

}  // namespace plastron::app

#include "commands.hpp"
#include "console.hpp"

#include <plastron/config/case.hpp>
#include <plastron/io/output.hpp>

#include <mpi.h>
#include <unistd.h>

#include <system_error>

namespace plastron::app {

namespace {

namespace fs = std::filesystem;

/// Why results cannot be written to `directory`; empty if they can. Makes nothing.
std::string obstacle_to_writing(const fs::path& directory) {
  std::error_code ignored;
  if (fs::exists(directory, ignored)) {
    if (!fs::is_directory(directory, ignored)) return "it is a file; name a directory";
    return access(directory.c_str(), W_OK | X_OK) == 0 ? "" : "it is not writable";
  }
  fs::path parent = fs::absolute(directory, ignored).parent_path();
  while (!fs::exists(parent, ignored) && parent.has_relative_path()) parent = parent.parent_path();
  if (!fs::is_directory(parent, ignored)) return fmt::format("{} is a file", parent.string());
  return access(parent.c_str(), W_OK | X_OK) == 0 ? "" : fmt::format("{} is not writable", parent.string());
}

ExitCode exit_code(contact::Status status) {
  switch (status) {
    case contact::Status::solved:
      return solved;
    case contact::Status::infeasible:
      return bad_input;
    default:
      return not_converged;
  }
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
    print_error("{}: not converged: {}\n", options.case_file.string(), contact::explain(result.status));
  return exit_code(result.status);
}

}  // namespace plastron::app

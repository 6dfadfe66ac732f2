// The commands of plastron-study.
#include "command_line.hpp"
#include "console.hpp"

#include "status_line.hpp"
#include "terminal.hpp"

#include <research/report/study_report.hpp>
#include <research/study/kinds.hpp>
#include <research/study/variations.hpp>

#include <plastron/workflow/output_directory.hpp>
#include <plastron/workflow/read.hpp>

#include <fmt/format.h>
#include <mpi.h>

#include <optional>
#include <string>
#include <string_view>

namespace plastron::app {

namespace {

/// Shows the present stage of a study on a terminal.
class StageProgress {
 public:
  explicit StageProgress(bool quiet) : status_(quiet) {}

  study::StudyObserver observer() {
    study::StudyObserver observer;
    observer.stage = [this](std::string_view what) {
      log_event("stage", {{"stage", what}});
      stage_ = what;
      status_.show(stage_ + " ...");
    };
    observer.solve.level = [this](int level, const computation::Level& record) {
      log_level(level, record);
      status_.show(fmt::format("{}: level {} done, {} unknowns", stage_, level, record.unknowns));
    };
    observer.solve.stop = is_interrupted;
    return observer;
  }
  void finish() { status_.clear(); }

 private:
  StatusLine status_;
  std::string stage_{};
};

/// Returns the study of that name, or one of the comparisons that are separate commands.
const study::Kind& kind_of(const std::string& name) {
  const study::Kind* kind = study::find_kind(name);
  if (kind != nullptr) return *kind;
  return name == study::solver_comparison().name ? study::solver_comparison() : study::comparison();
}

/// Logs the files of the report and its status as events.
void log_report(const study::Report& report, const StudyCommand& command) {
  const auto log_file = [&](const char* ending) {
    log_event("file", {{"path", (command.output / (report.table.name + ending)).string()}});
  };
  if (!command.output.empty()) log_file(".json");
  if (!command.output.empty() && !report.table.rows.empty()) log_file(".svg");
  if (!command.output.empty() && !report.meshes.empty()) log_file("-meshes.svg");
  log_status(report.status, contact::explain(report.status));
}

void print_report(const study::Report& report, const config::Case& c, const StudyCommand& command) {
  print_title(c.title, command.case_file.string());
  if (is_first_rank()) print_text(stdout, study::table_text(report.table));
  if (command.output.empty()) return;
  print("\nresults           {}\n", (command.output / (report.table.name + ".json")).string());
  if (!report.table.rows.empty())
    print("plot              {}\n", (command.output / (report.table.name + ".svg")).string());
  if (!report.meshes.empty())
    print("meshes            {}\n", (command.output / (report.table.name + "-meshes.svg")).string());
}

}  // namespace

ExitCode study_case(const StudyCommand& command) {
  const config::Case c = read_case(command.case_file, command.settings);
  const study::Kind& kind = kind_of(command.kind);
  const problem::Problem problem = kind.grades_meshes ? c.problem : study::on_uniform_meshes(c.problem);
  const auto findings =
      workflow::examine_together([&] { return study::examine(kind, problem, command.options); }, MPI_COMM_WORLD);
  print_findings(findings, command.case_file.string(), false);
  if (examination::has_errors(findings)) return bad_input;
  std::optional<workflow::OutputDirectory> output;
  if (!command.output.empty()) output.emplace(command.output, MPI_COMM_WORLD);
  if (output && !output->obstacle().empty()) {
    print_error("{}: error: results cannot be written here: {}\n", command.output.string(), output->obstacle());
    return bad_input;
  }

  StageProgress progress(command.quiet);
  const study::Report report = kind.run(problem, command.options, MPI_COMM_WORLD, progress.observer());
  progress.finish();
  if (exit_code(report.status) == bad_input) {
    log_status(report.status, contact::explain(report.status));
    print_error("{}: error: {}\n", command.case_file.string(), contact::explain(report.status));
    return bad_input;
  }
  if (output)
    study::write_report(report, {.title = c.title, .settings = c.effective, .files = {}}, command.output,
                        MPI_COMM_WORLD);
  log_report(report, command);
  if (!command.quiet) print_report(report, c, command);
  if (report.status != contact::Status::solved)
    print_error("{}: {}: {}\n", command.case_file.string(),
                report.status == contact::Status::interrupted ? "interrupted" : "not converged",
                contact::explain(report.status));
  return exit_code(report.status);
}

ExitCode carry_out(const CommandLine& line) {
  const Options& options = line.options;
  if (line.study->parsed()) return study_case(line.study_options);
  return study_case({.kind = options.solvers ? "compare-solvers" : "compare",
                     .case_file = options.case_file,
                     .output = options.output,
                     .settings = options.settings,
                     .quiet = options.quiet});
}

}  // namespace plastron::app

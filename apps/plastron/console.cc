#include "console.hpp"
#include "terminal.hpp"

#include <plastron/geometry/quotation.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/workflow/output.hpp>
#include <plastron/workflow/read.hpp>

#include <mpi.h>
#include <signal.h>

#include <initializer_list>
#include <stdexcept>
#include <utility>

namespace plastron::app {

config::Case read_case(const std::filesystem::path& path, std::span<const std::string> settings) {
  config::Case c = workflow::read_together([&] { return config::read_case(path, settings); }, MPI_COMM_WORLD);
  set_unit_names(c.problem.output.units);
  return c;
}

void print_title(const std::string& title, const std::string& without) {
  if (!is_first_rank()) return;
  print_raw(stdout, config::printable(title.empty() ? without : geometry::shortened(title, 100)) + "\n");
}

void print_findings(const std::vector<examination::Finding>& findings, const std::string& case_file, bool with_notes) {
  using examination::Severity;
  for (const examination::Finding& f : findings) {
    const char* severity = workflow::to_string(f.severity);
    if (is_logging_events())
      log_event("finding", {{"severity", severity}, {"text", with_unit_names(f.text)}});
    else if (f.severity != Severity::note)
      print_error("{}: {}: {}\n", case_file, severity, f.text);
    if (f.severity == Severity::note && with_notes) print("  {}\n", f.text);
  }
}

void print_warning(const std::string& case_file, std::string_view text) {
  if (is_logging_events())
    log_event("warning", {{"text", with_unit_names(text)}});
  else
    print_error("{}: warning: {}\n", case_file, text);
}

void log_status(contact::Status status, std::string_view text) {
  log_event("status", {{"status", contact::to_string(status)}, {"text", with_unit_names(text)}});
}

void log_level(int level, const computation::Level& record) {
  if (!is_logging_events()) return;
  Details details{{"level", level}};
  details.update(io::record_json(io::level_quantities(), record));
  log_event("level_end", details);
}

namespace {

volatile sig_atomic_t interrupted = 0;

extern "C" void note_interruption(int) { interrupted = 1; }

}  // namespace

void listen_for_interruptions() {
  struct sigaction action {};
  action.sa_handler = note_interruption;
  // The first signal restores the default: the second ends the program.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
}

bool is_interrupted() { return interrupted != 0; }

}  // namespace plastron::app

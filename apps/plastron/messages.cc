#include "messages.hpp"

#include "event_log.hpp"
#include "terminal.hpp"

#include <plastron/geometry/quotation.hpp>
#include <plastron/io/quantities.hpp>

namespace plastron::app {

void print_title(const std::string& title, const std::string& without) {
  if (!is_first_rank()) return;
  print_raw(stdout, config::printable(title.empty() ? without : geometry::shortened(title, 100)) + "\n");
}

void print_findings(const std::vector<examination::Finding>& findings, const std::string& case_file, bool with_notes) {
  using examination::Severity;
  for (const examination::Finding& f : findings) {
    const char* severity = f.severity == Severity::error     ? "error"
                           : f.severity == Severity::warning ? "warning"
                                                             : "note";
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

}  // namespace plastron::app

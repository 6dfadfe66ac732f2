#include "commands.hpp"
#include "messages.hpp"
#include "reading.hpp"
#include "terminal.hpp"

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

}  // namespace plastron::app

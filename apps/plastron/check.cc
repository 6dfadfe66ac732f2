#include "commands.hpp"
#include "progress.hpp"
#include "reading.hpp"

namespace plastron::app {

ExitCode check(const std::filesystem::path& case_file) {
  const config::Case c = read_case(case_file);
  print("{}: {}\n", case_file.string(), c.title.empty() ? "untitled" : shortened_title(c.title));
  const auto findings = examine_together([&] { return examination::examine(c.problem); });
  print_findings(findings, case_file.string(), true);
  if (examination::has_errors(findings)) return bad_input;
  print("  ready to run\n");
  return solved;
}

}  // namespace plastron::app

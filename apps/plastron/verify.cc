// plastron verify DIR: checks whether given results solve their case.
#include "command_line.hpp"
#include "console.hpp"
#include "terminal.hpp"

#include <plastron/workflow/verify.hpp>

#include <mpi.h>

#include <algorithm>
#include <array>

namespace plastron::app {

namespace {

/// Whether a part of results.json is printed even where it agrees.
bool is_worth_a_line(const std::string& path) {
  constexpr std::array parts{"energy", "load_work", "contact.area", "contact.max_pressure"};
  constexpr std::array lists{"reaction.force[", "support_reaction.force["};
  const bool is_of_probe = path.starts_with("probes.") && path.find(".u[") != std::string::npos;
  return is_of_probe || std::ranges::any_of(parts, [&](const char* part) { return path == part; }) ||
         std::ranges::any_of(lists, [&](const char* list) { return path.starts_with(list); });
}

const char* verdict(bool holds) { return holds ? "ok" : "NO"; }

/// Prints a row with a limit: a row of the certificate, or one that shows whether the solution belongs to the case.
void print_row(const certificate::CertificateLimit& row, const std::string& claimed) {
  print("{:<20} {:>15.6g} {:>15} {:>3}{:>12.3g} {:<5} {}\n", row.row, row.value, claimed,
        row.is_least ? ">=" : "<=", row.limit, row.unit == "1" ? std::string_view() : row.unit, verdict(row.holds()));
}

std::string claimed_row(const io::Json& results, std::string_view row) {
  const io::Json::json_pointer place = io::Json::json_pointer("/certificate/" + std::string(row));
  if (!results.contains(place) || !results[place].is_number()) return "-";
  return fmt::format("{:.6g}", results[place].get<double>());
}

void print_rows(const workflow::Judgement& judgement) {
  print("{:<20} {:>15} {:>15} {:>15}\n", "row", "recomputed", "claimed", "limit");
  for (const auto& row : judgement.recomputed.result.limits) print_row(row, claimed_row(judgement.claimed, row.row));
  for (const auto& row : judgement.recomputed.membership) print_row(row, "");
}

void print_numbers(const std::vector<io::Comparison>& numbers) {
  print("\n{:<36} {:>17} {:>17} {:>12}\n", "number", "recomputed", "claimed", "within");
  for (const io::Comparison& c : numbers)
    if (!c.agrees || is_worth_a_line(c.path))
      print("{:<36} {:>17} {:>17} {:>12.2g} {}\n", c.path, io::shown(c.recomputed), io::shown(c.claimed), c.tolerance,
            verdict(c.agrees));
  print("{} numbers of results.json recomputed, {} agree\n", numbers.size(),
        std::ranges::count_if(numbers, &io::Comparison::agrees));
}

/// Prints the number of unchanged files. The numbers above follow from the solution; only a checksum exists for the rest.
void print_files(const io::StoredChecksums& files) {
  print(
      "{} of {} files have the SHA-256 that run stored. Only this tests title, warnings, estimates and times of "
      "results.json, and report.html, .vtu, .csv, .svg and .pvd\n",
      files.files - std::min(files.files, files.failures.size()), files.files);
}

/// Prints the last line, and returns the exit code.
ExitCode conclude(const std::vector<std::string>& failures, bool quiet) {
  constexpr std::size_t most = 5;
  if (failures.empty()) {
    if (!quiet) print("\nPASSED\n");
    return solved;
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(most, failures.size()); ++i) text += (i > 0 ? "; " : "") + failures[i];
  if (failures.size() > most) text += fmt::format("; and {} more", failures.size() - most);
  if (quiet)
    print_error("FAILED: {}\n", text);
  else
    print("\nFAILED: {}\n", text);
  return not_verified;
}

/// Prints the versions. Another version may discretise differently, which matters where rows fail.
void print_versions(const io::Json& results) {
  const io::Json::json_pointer place("/versions/plastron");
  if (!results.contains(place) || !results[place].is_string() || results[place] == io::Json(io::version)) return;
  print("written by version {}, verified by version {}\n", results[place].get<std::string>(), io::version);
}

}  // namespace

ExitCode verify(const Options& options) {
  const workflow::Judgement judgement = workflow::verify(options.results, options.files, MPI_COMM_WORLD);
  if (judgement.read_case) set_unit_names(judgement.read_case->problem.output.units);
  if (!options.quiet && judgement.read_case) {
    print_versions(judgement.claimed);
    print_title(judgement.read_case->title, options.results.string());
    print("\n");
    print_rows(judgement);
    print_numbers(judgement.numbers);
    print_files(judgement.files);
  }
  return conclude(judgement.failures, options.quiet);
}

}  // namespace plastron::app

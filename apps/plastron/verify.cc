// plastron verify DIR: checks whether given results solve their case.
#include "command_line.hpp"
#include "console.hpp"
#include "terminal.hpp"

#include <plastron/io/claims.hpp>
#include <plastron/io/results.hpp>
#include <plastron/io/solution_file.hpp>

#include <mpi.h>

#include <algorithm>
#include <array>

namespace plastron::app {

namespace {

using Failures = std::vector<std::string>;

/// Whether a part of results.json is printed even where it agrees.
bool is_worth_a_line(const std::string& path) {
  constexpr std::array parts{"energy", "load_work", "contact.area", "contact.max_pressure"};
  constexpr std::array lists{"reaction.force[", "support_reaction.force["};
  const bool is_of_probe = path.starts_with("probes.") && path.find(".u[") != std::string::npos;
  return is_of_probe || std::ranges::any_of(parts, [&](const char* part) { return path == part; }) ||
         std::ranges::any_of(lists, [&](const char* list) { return path.starts_with(list); });
}

std::string shown(const io::Json& value) {
  return value.is_number_float() ? fmt::format("{:.9g}", value.get<double>()) : value.is_null() ? "-" : value.dump();
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

void judge_rows(const computation::Verification& verification, const io::Json& claimed, bool quiet,
                Failures& failures) {
  if (!quiet) print("{:<20} {:>15} {:>15} {:>15}\n", "row", "recomputed", "claimed", "limit");
  for (const auto* rows : {&verification.result.limits, &verification.membership})
    for (const certificate::CertificateLimit& row : *rows) {
      if (!quiet) print_row(row, rows == &verification.membership ? "" : claimed_row(claimed, row.row));
      if (!row.holds()) failures.push_back(fmt::format("{} ({})", row.text(), row.reason));
    }
}

void judge_numbers(const std::vector<io::Comparison>& numbers, bool quiet, Failures& failures) {
  if (!quiet) print("\n{:<36} {:>17} {:>17} {:>12}\n", "number", "recomputed", "claimed", "within");
  std::size_t agreeing = 0;
  for (const io::Comparison& c : numbers) {
    if (c.agrees) ++agreeing;
    if (!quiet && (!c.agrees || is_worth_a_line(c.path)))
      print("{:<36} {:>17} {:>17} {:>12.2g} {}\n", c.path, shown(c.recomputed), shown(c.claimed), c.tolerance,
            verdict(c.agrees));
    if (!c.agrees)
      failures.push_back(fmt::format("results.json claims {} = {}, the recomputed value is {}", c.path,
                                     shown(c.claimed), shown(c.recomputed)));
  }
  if (!quiet) print("{} numbers of results.json recomputed, {} agree\n", numbers.size(), agreeing);
}

void judge_settings(const std::vector<io::Comparison>& settings, Failures& failures) {
  for (const io::Comparison& c : settings)
    failures.push_back(
        fmt::format("results.json claims {} = {}, the case has {}", c.path, shown(c.claimed), shown(c.recomputed)));
}

/// Judges the files. The numbers above follow from the solution; only a checksum exists for the rest.
void judge_files(const io::StoredChecksums& files, bool quiet, Failures& failures) {
  if (!quiet)
    print(
        "{} of {} files have the SHA-256 that run stored. Only this tests title, warnings, estimates and times of "
        "results.json, and report.html, .vtu, .csv, .svg and .pvd\n",
        files.files - std::min(files.files, files.failures.size()), files.files);
  failures.insert(failures.end(), files.failures.begin(), files.failures.end());
}

/// Prints the last line, and returns the exit code.
ExitCode conclude(const Failures& failures, bool quiet) {
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
void print_versions(const io::Json& results, bool quiet) {
  const io::Json::json_pointer place("/versions/plastron");
  if (quiet || !results.contains(place) || !results[place].is_string() || results[place] == io::Json(io::version))
    return;
  print("written by version {}, verified by version {}\n", results[place].get<std::string>(), io::version);
}

/// Checks that results.json has checksums of the files that the case names.
void check_names(const config::Case& c, const io::Claims& claims) {
  for (const auto& [name, path] : c.files)
    if (std::ranges::find(claims.files, name, &io::SourceFile::name) == claims.files.end())
      throw io::UnusableResults(
          fmt::format("the case names the file \"{}\", and results.json has no checksum of it", name));
}

}  // namespace

ExitCode verify(const Options& options) {
  const io::Claims claims = io::read_claims(options.results, MPI_COMM_WORLD);
  if (claims.status != contact::to_string(contact::Status::solved))
    return conclude({fmt::format("the status of these results is \"{}\"", claims.status)}, options.quiet);
  if (claims.solution.empty())
    throw io::UnusableResults("results.json names no file with the solution: there is nothing to verify");
  const auto& folder = options.files.empty() ? claims.case_folder : options.files;
  io::check_sources(claims, folder, MPI_COMM_WORLD);
  const config::Case c = read_case(claims.case_copy, folder);
  check_names(c, claims);
  const io::StoredChecksums files = io::compare_checksums(options.results, claims.results, MPI_COMM_WORLD);
  print_versions(claims.results, options.quiet);
  if (!options.quiet) {
    print_title(c.title, claims.case_copy.string());
    print("\n");
  }

  const auto cells = c.problem.accuracy ? io::stored_cells(claims.solution, MPI_COMM_WORLD) : computation::MeshCells{};
  const computation::FinestMesh mesh = computation::finest_mesh(c.problem, MPI_COMM_WORLD, cells);
  const bool is_mixed = c.problem.shell.tangency.formulation == element::Formulation::mixed;
  auto solution = io::read_solution(claims.solution, mesh.space,
                                    {.obstacles = static_cast<int>(c.problem.shell.obstacles.all.size()),
                                     .has_multiplier = is_mixed,
                                     .has_lifts = c.problem.admissible && !c.problem.shell.obstacles.empty()});
  const computation::Verification verification = computation::verify(c.problem, mesh, std::move(solution));
  Failures failures;
  judge_rows(verification, claims.results, options.quiet, failures);
  judge_numbers(io::compare_numbers(claims.results, verification.result), options.quiet, failures);
  judge_settings(io::differing_settings(claims.results.value("settings", io::Json()), c.effective), failures);
  judge_files(files, options.quiet, failures);
  return conclude(failures, options.quiet);
}

}  // namespace plastron::app

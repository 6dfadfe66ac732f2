#include "console.hpp"
#include "terminal.hpp"

#include <plastron/algebra/agreement.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/geometry/quotation.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/output.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/obstacle/error.hpp>

#include <mpi.h>
#include <signal.h>

#include <initializer_list>
#include <stdexcept>
#include <utility>

namespace plastron::app {

namespace {

config::Case read_together(const std::function<config::Case()>& read) {
  config::Case c = algebra::in_agreement<RefusedCase>(MPI_COMM_WORLD, [&] {
    try {
      return read();
    } catch (const config::CaseErrors& errors) {
      throw RefusedCase(errors.format());
    }
  });
  set_unit_names(c.problem.output.units);
  c.problem.domain =
      domain::with_shared_mesh(std::move(c.problem.domain), c.problem.discretisation.cells, MPI_COMM_WORLD);
  try {
    problem::locate_points(c.problem);
  } catch (const mesh::DomainError&) {  // the examination and the solution report what is wrong with the mesh
  }
  return c;
}

// Packs findings so that the first rank can send them: for each a letter for its severity, its text and a zero.
std::string in_one_text(const std::vector<examination::Finding>& findings) {
  std::string all;
  for (const examination::Finding& finding : findings) {
    all += static_cast<char>('0' + static_cast<int>(finding.severity));
    all += finding.text;
    all += '\0';
  }
  return all;
}

std::vector<examination::Finding> from_one_text(const std::string& all) {
  std::vector<examination::Finding> findings;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = all.find('\0', at);
    findings.push_back({static_cast<examination::Severity>(all[at] - '0'), all.substr(at + 1, end - at - 1)});
    at = end + 1;
  }
  return findings;
}

}  // namespace

config::Case read_case(const std::filesystem::path& path, std::span<const std::string> settings) {
  return read_together([&] { return config::read_case(path, settings); });
}

config::Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder) {
  return read_together([&] { return config::read_case(path, folder); });
}

std::vector<examination::Finding> examine_together(
    const std::function<std::vector<examination::Finding>()>& examination) {
  const auto mine = algebra::in_agreement<mesh::DomainError, obstacle::ObstacleError>(
      MPI_COMM_WORLD, [&] { return is_first_rank() ? examination() : std::vector<examination::Finding>{}; });
  return from_one_text(algebra::first_words(in_one_text(mine), MPI_COMM_WORLD));
}

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

OutputDirectory::OutputDirectory(const std::filesystem::path& directory) {
  try {
    io::try_directory(directory, MPI_COMM_WORLD, made_);
  } catch (const std::runtime_error& error) {
    obstacle_ = error.what();
  }
}

OutputDirectory::OutputDirectory(const std::filesystem::path& directory,
                                 const std::vector<std::filesystem::path>& inputs)
    : OutputDirectory(directory) {
  if (!obstacle_.empty()) return;
  try {
    io::check_replaceable(directory, base_name, inputs, MPI_COMM_WORLD);
  } catch (const std::runtime_error& error) {
    obstacle_ = error.what();
  }
}

OutputDirectory::~OutputDirectory() { io::remove_empty(made_, MPI_COMM_WORLD); }

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

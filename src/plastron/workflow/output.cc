#include <plastron/workflow/output.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/contact_report.hpp>
#include <plastron/io/csv_tables.hpp>
#include <plastron/io/mode_file.hpp>
#include <plastron/io/obstacle_surfaces.hpp>
#include <plastron/io/plot.hpp>
#include <plastron/io/result_plots.hpp>
#include <plastron/io/solution_file.hpp>
#include <plastron/io/vtu.hpp>
#include <plastron/report/report.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace plastron::workflow {

namespace {

/// Whether the solution can be drawn. A singular system gives displacements that no viewer can show.
bool can_be_drawn(const computation::Solution& solution, MPI_Comm comm) {
  const auto y = solution.nodal.y.owned();
  const bool finite = std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
  return algebra::sum_over_ranks(static_cast<std::int64_t>(finite ? 0 : 1), comm) == 0;
}

/// Whether a run may write a file of this name.
bool is_written(std::string_view name, std::string_view base) {
  constexpr std::array exact{io::results_name, io::checksums_name, report::report_name, std::string_view("history.csv"),
                             std::string_view("history.svg")};
  const bool is_of_contact = name.starts_with("contact-"), is_of_line = name.starts_with("line-");
  const bool are_fields = name.starts_with(base) || name.starts_with("obstacles") || name.starts_with("solid") ||
                          io::is_envelope_name(name);
  return std::ranges::find(exact, name) != exact.end() || ((is_of_contact || is_of_line) && name.ends_with(".csv")) ||
         ((is_of_contact || are_fields) && name.ends_with(".vtu")) || io::is_mode_name(name) ||
         (name.starts_with(base) && std::ranges::any_of(std::array{".pvd", ".plastron", ".case.toml"},
                                                        [&](const char* end) { return name.ends_with(end); }));
}

std::string in_the_way(const std::filesystem::path& directory, const std::string& base,
                       const std::vector<std::filesystem::path>& inputs) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    if (entry.is_directory(ignored) && is_written(entry.path().filename().string(), base))
      return fmt::format("\"{}\" is a directory; a file of this name cannot be written", entry.path().string());
  for (const std::filesystem::path& input : inputs) {
    const auto path = std::filesystem::weakly_canonical(input);
    if (is_written(path.filename().string(), base) &&
        std::filesystem::equivalent(path.parent_path(), directory, ignored))
      return fmt::format("the case is read from \"{}\", which the results would replace; choose another directory",
                         input.string());
  }
  return "";
}

}  // namespace

void check_replaceable(const std::filesystem::path& directory, const std::string& base,
                       const std::vector<std::filesystem::path>& inputs, MPI_Comm comm) {
  algebra::in_agreement(comm, [&] {
    const std::string words = in_the_way(directory, base, inputs);
    if (!words.empty()) throw std::runtime_error(words);
  });
}

Output::Output(std::filesystem::path directory, std::string base, MPI_Comm comm, bool with_report,
               problem::Output given)
    : directory_(std::move(directory)),
      base_name_(std::move(base)),
      files_(comm),
      with_report_(with_report),
      given_(std::move(given)),
      envelopes_(given_.envelopes.begin(), given_.envelopes.end()) {
  io::make_directory(directory_, comm);
}

void Output::add_instant(const computation::HistoryEntry& entry, const computation::Solution& solution) {
  if (!can_be_drawn(solution, files_.comm())) return;
  add_fields(solution, entry.factors.time, fmt::format("-{:04}", ++instants_), true);
  if (!envelopes_.empty()) {
    const io::GridPiece piece = io::case_piece(solution, {.heights = given_.heights, .units = given_.units});
    for (io::EnvelopeFields& envelope : envelopes_) envelope.add(entry.step, piece, files_.comm());
  }
  if (with_report_) frames_.add(entry, solution);
}

std::vector<std::string> Output::warnings() const {
  std::vector<std::string> texts;
  for (const io::EnvelopeFields& envelope : envelopes_)
    if (envelope.has_several_meshes())
      texts.push_back(
          fmt::format("the envelope \"{}\" has numbers and no fields, because the meshes of its load cases differ; for "
                      "the file {} remove "
                      "[accuracy] and give one mesh in [mesh]",
                      envelope.name(), envelope.file_name()));
  return texts;
}

/// Adds the shell and the obstacles, as parts of the time series if requested.
void Output::add_fields(const computation::Solution& solution, double time, const std::string& suffix,
                        bool is_in_series) {
  const auto keep = [&](const std::string& name, int part) {
    names_.push_back(name);
    if (is_in_series) series_.push_back({time, name, part});
  };
  const std::string shell = base_name_ + suffix + ".vtu", obstacles = "obstacles" + suffix + ".vtu";
  io::add_vtu(solution, directory_ / shell, files_,
              {.heights = given_.heights, .is_double = given_.double_precision, .units = given_.units});
  keep(shell, 0);
  if (io::add_obstacle_surfaces(solution, directory_ / obstacles, files_)) keep(obstacles, 1);
  if (given_.solid_layers == 0) return;
  names_.push_back("solid" + suffix + ".vtu");
  io::add_solid(solution, given_.solid_layers, directory_ / names_.back(), files_,
                {.is_double = given_.double_precision, .units = given_.units});
}

/// Adds a text that only the first rank writes.
void Output::add_text(const std::string& name, const io::Piece& text) {
  names_.push_back(name);
  files_.add_text(directory_ / name, text);
}

void Output::add_history(const computation::Result& result) {
  add_text("history.csv", [&] { return io::history_csv(result); });
  add_text("history.svg",
           [&] { return io::svg_text(io::renamed(io::history_plot(io::history_json(result)), given_.units)); });
}

/// Adds checksums in the format of sha256sum.
void Output::add_checksums() {
  files_.add_text(directory_ / io::checksums_name, [&] {
    std::string text;
    for (const io::AtomicFiles::File& file : files_.added())
      text += fmt::format("{}  {}\n", io::checksum_of_file(file.temporary).hash, file.path.filename().string());
    return text;
  });
}

std::vector<std::string> Output::finish(const computation::Result& result, io::Provenance provenance,
                                        const std::vector<problem::Line>& lines) {
  const std::size_t files = files_.added().size(), names = names_.size(), sets = series_.size();
  try {
    return add_all(result, std::move(provenance), lines);
  } catch (...) {  // the files of instants stay
    files_.keep_first(files);
    names_.resize(names);
    series_.resize(sets);
    throw;
  }
}

std::vector<std::string> Output::add_all(const computation::Result& result, io::Provenance provenance,
                                         const std::vector<problem::Line>& lines) {
  const bool is_drawn = result.solution && can_be_drawn(*result.solution, files_.comm());
  if (is_drawn) {
    add_fields(*result.solution, 0, "", series_.empty());
    provenance.solution = base_name_ + ".plastron";
    names_.push_back(provenance.solution);
    io::add_solution(*result.solution, directory_ / provenance.solution, files_);
    std::ranges::move(io::add_modes(*result.solution, directory_, files_), std::back_inserter(names_));
  }
  std::vector<io::LineTable> tables;
  if (is_drawn) tables = io::line_tables(*result.solution, lines, given_);
  for (const io::LineTable& table : tables) add_text(fmt::format("line-{}.csv", table.name), [&] { return table.csv; });
  for (const io::EnvelopeFields& envelope : envelopes_)
    if (envelope.is_complete()) {
      names_.push_back(envelope.file_name());
      io::add_grid(
          directory_ / names_.back(), [&] { return envelope.piece(); }, given_.double_precision, files_);
    }
  if (!series_.empty()) {
    names_.push_back(base_name_ + ".pvd");
    io::add_pvd(series_, directory_ / names_.back(), files_);
  }
  std::vector<std::string> boundary;
  if (is_drawn) boundary = io::add_contact_report(result.summary, *result.solution, directory_, files_);
  names_.insert(names_.end(), boundary.begin(), boundary.end());
  if (!result.history.empty()) add_history(result);
  if (provenance.part_mesh) add_text(base_name_ + ".msh", [&] { return *provenance.part_mesh; });
  if (provenance.source) {
    provenance.case_copy = base_name_ + ".case.toml";
    add_text(provenance.case_copy, [&] { return provenance.source->text; });
  }
  if (with_report_) names_.emplace_back(report::report_name);
  names_.emplace_back(io::checksums_name);
  provenance.heights = given_.heights;
  provenance.units = given_.units;
  provenance.files = names_;
  if (with_report_) report::add_report(result, provenance, is_drawn, frames_, tables, directory_, files_);
  io::add_results(result, provenance, directory_, files_);
  add_checksums();
  files_.commit(io::results_name);
  if (boundary.empty()) io::remove_contact_report(directory_, files_.comm());
  io::remove_files(directory_, files_.comm(), [&](const std::string& name) {
    return (io::is_mode_name(name) || io::is_envelope_name(name)) && std::ranges::count(names_, name) == 0;
  });
  if (!with_report_) io::remove_file(directory_ / report::report_name, files_.comm());
  if (given_.solid_layers == 0) io::remove_file(directory_ / io::solid_name, files_.comm());
  names_.emplace_back(io::results_name);
  return names_;
}

void write_output(const computation::Result& result, io::Provenance provenance, const std::filesystem::path& directory,
                  const std::string& base, MPI_Comm comm) {
  Output(directory, base, comm).finish(result, std::move(provenance));
}

}  // namespace plastron::workflow

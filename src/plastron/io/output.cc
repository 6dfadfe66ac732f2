#include <plastron/io/output.hpp>

#include <plastron/io/atomic_file.hpp>
#include <plastron/io/contact_report.hpp>
#include <plastron/io/history.hpp>
#include <plastron/io/line_table.hpp>
#include <plastron/io/obstacle_surfaces.hpp>
#include <plastron/io/plot.hpp>
#include <plastron/io/report.hpp>
#include <plastron/io/result_plots.hpp>
#include <plastron/io/solid.hpp>
#include <plastron/io/solution_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::io {

namespace {

/// A singular system leaves displacements that no viewer can show.
bool can_be_drawn(const computation::Solution& solution, MPI_Comm comm) {
  const auto y = solution.nodal.y.owned();
  const bool finite = std::all_of(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
  return algebra::sum_over_ranks(static_cast<std::int64_t>(finite ? 0 : 1), comm) == 0;
}

}  // namespace

Output::Output(std::filesystem::path directory, std::string base_name, MPI_Comm comm, bool with_report,
               computation::Output given)
    : directory_(std::move(directory)),
      base_name_(std::move(base_name)),
      files_(comm),
      with_report_(with_report),
      given_(std::move(given)) {
  make_directory(directory_, comm);
}

void Output::add_instant(const computation::HistoryEntry& entry, const computation::Solution& solution) {
  if (can_be_drawn(solution, files_.comm())) add_fields(solution, entry.time, fmt::format("-{:04}", ++instants_), true);
}

/// The shell and the obstacles, as parts of the time series if they are for that.
void Output::add_fields(const computation::Solution& solution, double time, const std::string& suffix,
                        bool is_in_series) {
  const auto keep = [&](const std::string& name, int part) {
    names_.push_back(name);
    if (is_in_series) series_.push_back({time, name, part});
  };
  const std::string shell = base_name_ + suffix + ".vtu", obstacles = "obstacles" + suffix + ".vtu";
  add_vtu(solution, directory_ / shell, files_, {.heights = given_.heights, .is_double = given_.double_precision});
  keep(shell, 0);
  if (add_obstacle_surfaces(solution, directory_ / obstacles, files_)) keep(obstacles, 1);
  if (given_.solid_layers == 0) return;
  names_.push_back("solid" + suffix + ".vtu");
  add_solid(solution, given_.solid_layers, directory_ / names_.back(), files_, given_.double_precision);
}

/// Written by the first rank alone.
void Output::add_text(const std::string& name, const Piece& text) {
  int rank = 0;
  MPI_Comm_rank(files_.comm(), &rank);
  names_.push_back(name);
  files_.add(directory_ / name, [&] { return rank == 0 ? text() : std::string(); });
}

void Output::add_history(const computation::Result& result) {
  add_text("history.csv", [&] { return history_csv(result); });
  add_text("history.svg", [&] { return svg_text(history_plot(history_json(result))); });
}

std::vector<std::string> Output::finish(const computation::Result& result, Provenance provenance,
                                        const std::vector<computation::Line>& lines) {
  const bool is_drawn = result.solution && can_be_drawn(*result.solution, files_.comm());
  if (is_drawn) {
    add_fields(*result.solution, 0, "", series_.empty());
    provenance.solution = base_name_ + ".plastron";
    names_.push_back(provenance.solution);
    add_solution(*result.solution, directory_ / provenance.solution, files_);
  }
  const auto keep_all = [this](const std::vector<std::string>& more) {
    names_.insert(names_.end(), more.begin(), more.end());
  };
  if (is_drawn) keep_all(add_lines(*result.solution, lines, given_.heights, directory_, files_));
  if (!series_.empty()) {
    names_.push_back(base_name_ + ".pvd");
    add_pvd(series_, directory_ / names_.back(), files_);
  }
  std::vector<std::string> boundary;
  if (is_drawn) boundary = add_contact_report(result.summary, *result.solution, directory_, files_);
  keep_all(boundary);
  if (!result.history.empty()) add_history(result);
  if (provenance.source) {
    provenance.case_copy = base_name_ + ".case.toml";
    add_text(provenance.case_copy, [&] { return provenance.source->text; });
  }
  if (with_report_) names_.emplace_back(report_name);
  provenance.heights = given_.heights;
  provenance.files = names_;
  if (with_report_) add_report(result, provenance, is_drawn, directory_, files_);
  add_results(result, provenance, directory_, files_);
  files_.commit();
  if (boundary.empty()) remove_contact_report(directory_, files_.comm());
  if (!with_report_) remove_file(directory_ / report_name, files_.comm());
  if (given_.solid_layers == 0) remove_file(directory_ / solid_name, files_.comm());
  names_.emplace_back(results_name);
  return names_;
}

void write_output(const computation::Result& result, Provenance provenance, const std::filesystem::path& directory,
                  const std::string& base_name, MPI_Comm comm) {
  Output(directory, base_name, comm).finish(result, std::move(provenance));
}

}  // namespace plastron::io

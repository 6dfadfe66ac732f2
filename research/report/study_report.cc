#include <research/report/study_report.hpp>

#include <plastron/io/atomic_file.hpp>
#include <plastron/io/plot.hpp>
#include <plastron/io/results.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::study {

using io::AtomicFiles, io::make_directory, io::number, io::Provenance, io::remove_file, io::svg_text;

namespace {

std::string entry_text(const Entry& entry) {
  if (const auto* text = std::get_if<std::string>(&entry)) return *text;
  if (const auto* count = std::get_if<std::int64_t>(&entry)) return std::to_string(*count);
  const double value = std::get<double>(entry);
  return std::isnan(value) ? "-" : fmt::format("{:.4g}", value);
}

Json entry_json(const Entry& entry) {
  if (const auto* text = std::get_if<std::string>(&entry)) return *text;
  if (const auto* count = std::get_if<std::int64_t>(&entry)) return *count;
  return number(std::get<double>(entry));
}

/// Characters, not bytes.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

using Line = std::vector<std::string>;

std::string aligned(const std::vector<Line>& lines) {
  std::vector<std::size_t> widths;
  for (const Line& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], characters(line[c]));
  }
  std::string text;
  for (const Line& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c)
      text += std::string(widths[c] - characters(line[c]) + (c > 0 ? 2 : 0), ' ') + line[c];
    text += '\n';
  }
  return text;
}

std::string unit_text(const std::string& unit) { return unit == "-" || unit == "1" ? "" : "[" + unit + "]"; }

std::string fit_text(const Fit& fit) {
  if (!std::isfinite(fit.exponent)) return fmt::format("{}: no exponent of {}\n", fit.quantity, fit.against);
  return fmt::format("{} ~ {}^{:.2f}\n", fit.quantity, fit.against, fit.exponent);
}

std::string claim_text(const Claim& claim) {
  if (claim.verdict == Verdict::cannot_be_judged)
    return fmt::format("{}: {}: {}\n", claim.statement, to_string(claim.verdict), claim.reason);
  return fmt::format("{}: {}: {}\n", claim.statement, claim.measured, to_string(claim.verdict));
}

/// "holds" is null where nothing can be said; then "reason" says why.
Json claim_json(const Claim& claim) {
  Json json{{"claim", claim.statement}, {"measured", claim.measured}, {"holds", nullptr}};
  if (claim.verdict != Verdict::cannot_be_judged) json["holds"] = claim.verdict == Verdict::holds;
  json["verdict"] = to_string(claim.verdict);
  json["reason"] = claim.reason;
  return json;
}

Json plot_json(const io::Plot& plot) {
  const auto numbers = [](const std::vector<double>& values) {
    Json list = Json::array();
    for (const double v : values) list.push_back(number(v));
    return list;
  };
  Json series = Json::array();
  for (const auto& s : plot.series) series.push_back({{"label", s.label}, {"x", numbers(s.x)}, {"y", numbers(s.y)}});
  return {{"title", plot.title}, {"x", plot.x.label}, {"y", plot.y.label}, {"series", series}};
}

}  // namespace

std::string table_text(const Table& table) {
  std::vector<Line> lines(2);
  for (const Column& c : table.columns) {
    lines[0].push_back(c.name);
    lines[1].push_back(unit_text(c.unit));
  }
  for (const auto& row : table.rows) {
    lines.emplace_back();
    for (const Entry& entry : row) lines.back().push_back(entry_text(entry));
  }
  std::string text = table.title + "\n\n" + aligned(lines);
  if (!table.fits.empty()) text += "\n";
  for (const Fit& f : table.fits) text += fit_text(f);
  if (!table.claims.empty()) text += "\n";
  for (const Claim& c : table.claims) text += claim_text(c);
  if (!table.remarks.empty()) text += "\n";
  for (const std::string& r : table.remarks) text += r + "\n";
  return text;
}

Json report_json(const Report& report, const Provenance& provenance) {
  const Table& table = report.table;
  Json json{{"study", table.name},
            {"question", table.title},
            {"title", provenance.title},
            {"status", contact::to_string(report.status)},
            {"status_text", contact::explain(report.status)}};
  json["columns"] = Json::array();
  for (const Column& c : table.columns)
    json["columns"].push_back({{"name", c.name}, {"symbol", c.symbol}, {"unit", c.unit}});
  json["rows"] = Json::array();
  for (const auto& row : table.rows) {
    Json entries = Json::array();
    for (const Entry& entry : row) entries.push_back(entry_json(entry));
    json["rows"].push_back(std::move(entries));
  }
  json["fits"] = Json::array();
  for (const Fit& f : table.fits)
    json["fits"].push_back({{"quantity", f.quantity}, {"against", f.against}, {"exponent", number(f.exponent)}});
  json["claims"] = Json::array();
  for (const Claim& c : table.claims) json["claims"].push_back(claim_json(c));
  json["remarks"] = table.remarks;
  json["plot"] = plot_json(report.plot);
  json["files"] = provenance.files;
  json["settings"] = provenance.settings;
  json["version"] = io::version;
  return json;
}

void write_report(const Report& report, const Provenance& provenance, const std::filesystem::path& directory,
                  MPI_Comm comm) {
  const auto json_path = directory / (report.table.name + ".json"), svg_path = directory / (report.table.name + ".svg"),
             meshes_path = directory / (report.table.name + "-meshes.svg");
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const auto from_first = [rank](const auto& make) { return rank == 0 ? make() : std::string(); };
  make_directory(directory, comm);
  AtomicFiles files(comm);
  Provenance complete = provenance;
  const bool has_plot = !report.table.rows.empty();
  if (has_plot) {
    files.add(svg_path, [&] { return from_first([&] { return svg_text(report.plot); }); });
    complete.files = {svg_path.filename().string()};
  }
  const bool has_meshes = !report.meshes.empty();
  if (has_meshes) {
    files.add(meshes_path, [&] { return from_first([&] { return svg_of_meshes(report.meshes); }); });
    complete.files.push_back(meshes_path.filename().string());
  }
  files.add(json_path, [&] {
    return from_first(
        [&] { return report_json(report, complete).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; });
  });
  files.commit();
  if (!has_plot) remove_file(svg_path, comm);
  if (!has_meshes) remove_file(meshes_path, comm);
}

}  // namespace plastron::study

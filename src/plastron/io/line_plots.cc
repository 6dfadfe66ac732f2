#include <plastron/io/line_plots.hpp>
#include <plastron/io/unusable_results.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace plastron::io {

namespace {

/// Columns of one unit in a common plot. Absent and empty ones are ignored.
struct Profile {
  std::string_view name, label;
  std::array<std::string_view, 4> columns;
};

constexpr std::array profiles{
    Profile{"displacement", "displacement", {"displacement X", "displacement Y", "displacement Z"}},
    Profile{"gap", "gap", {"gap"}},
    Profile{"reaction", "reaction of the obstacles", {"eta"}},
    Profile{"membrane-forces", "membrane forces", {"N_11", "N_22", "N_12"}},
    Profile{"moments", "bending moments", {"M_11", "M_22", "M_12"}},
    Profile{"shear-forces", "transverse shear forces", {"Q_1", "Q_2"}},
    Profile{"von-mises", "equivalent stress", {"von_mises_lower", "von_mises_middle", "von_mises_upper", "von_mises"}},
};

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// The table by columns.
struct Columns {
  std::vector<std::string_view> names, units;
  std::vector<std::vector<double>> values;

  const std::vector<double>* find(std::string_view name) const {
    const auto at = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    return at < names.size() ? &values[at] : nullptr;
  }
};

[[noreturn]] void refuse(const std::string& name, std::size_t row, std::string_view what) {
  throw UnusableResults(fmt::format("line-{}.csv, line {}: {}; run the case again", name, row, what));
}

double number_in(std::string_view cell, const std::string& name, std::size_t row) {
  double value = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return value;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size())
    refuse(name, row, fmt::format("\"{}\" is no number", cell));
  return value;
}

Columns columns_of(const std::string& name, std::string_view csv) {
  std::vector<std::string_view> rows = split(csv, '\n');
  if (rows.back().empty()) rows.pop_back();
  Columns columns;
  if (rows.empty() || !rows.front().starts_with("s [")) refuse(name, 1, "the first column is not \"s\", a length");
  for (const std::string_view head : split(rows.front(), ',')) {
    const std::size_t bracket = head.find(" [");
    columns.names.push_back(head.substr(0, bracket));
    columns.units.push_back(bracket == std::string_view::npos ? std::string_view() : head.substr(bracket));
  }
  columns.values.resize(columns.names.size());
  for (std::size_t row = 1; row < rows.size(); ++row) {
    const auto cells = split(rows[row], ',');
    if (cells.size() != columns.names.size())
      refuse(name, row + 1, fmt::format("{} columns, where the first line has {}", cells.size(), columns.names.size()));
    for (std::size_t c = 0; c < cells.size(); ++c) columns.values[c].push_back(number_in(cells[c], name, row + 1));
  }
  return columns;
}

bool has_numbers(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return std::isfinite(value); });
}

}  // namespace

std::vector<NamedPlot> line_plots(const std::string& name, std::string_view csv) {
  constexpr std::size_t most_marks = 40;
  const Columns columns = columns_of(name, csv);
  const std::vector<double>& length = columns.values.front();
  std::vector<NamedPlot> plots;
  for (const Profile& profile : profiles) {
    Plot plot{.title = fmt::format("{} along {}", profile.label, name),
              .x = {fmt::format("length{}", columns.units.front())},
              .y = {}};
    for (const std::string_view column : profile.columns) {
      const std::vector<double>* values = column.empty() ? nullptr : columns.find(column);
      if (values == nullptr || !has_numbers(*values)) continue;
      const auto at = static_cast<std::size_t>(values - columns.values.data());
      plot.y.label = fmt::format("{}{}", profile.label, columns.units[at]);
      plot.series.push_back({.label = std::string(column), .x = length, .y = *values});
      plot.series.back().with_markers = length.size() <= most_marks;
    }
    if (!plot.series.empty()) plots.push_back({fmt::format("plot-line-{}-{}", name, profile.name), std::move(plot)});
  }
  return plots;
}

}  // namespace plastron::io

#include <plastron/io/result_plots.hpp>
#include <plastron/io/results.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace plastron::io {

namespace {

/// Returns NaN for null; plots omit it.
double value_of(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

double norm_of(const Json& vector) {
  double square = 0;
  for (const Json& component : vector) square += value_of(component) * value_of(component);
  return std::sqrt(square);
}

/// Returns a plot of one number of each mesh over the unknowns.
Plot over_meshes(const Json& levels, const std::string& key, std::string title, std::string label) {
  std::string series = key;
  std::ranges::replace(series, '_', ' ');
  Plot plot{.title = std::move(title), .x = {"unknowns", true}, .y = {std::move(label), false}};
  plot.series.push_back({.label = std::move(series), .x = {}, .y = {}});
  for (const Json& level : levels) {
    plot.series.back().x.push_back(value_of(level.at("unknowns")));
    plot.series.back().y.push_back(value_of(level.at(key)));
  }
  return plot;
}

/// Returns the relative difference from the finest mesh's value; the finest mesh has none.
Series change(const Json& levels, const std::string& key, std::string label) {
  Series series{.label = std::move(label), .x = {}, .y = {}};
  const double finest = value_of(levels.back().at(key));
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    series.x.push_back(value_of(levels[i].at("unknowns")));
    series.y.push_back(std::abs(value_of(levels[i].at(key)) / finest - 1));
  }
  return series;
}

Plot change_to_finest(const Json& levels, bool has_contact) {
  Plot plot{.title = "Change to the finest mesh", .x = {"unknowns", true}, .y = {"|value / finest - 1|", true}};
  plot.series.push_back(change(levels, "energy", "energy"));
  if (has_contact) {
    plot.series.push_back(change(levels, "reaction", "reaction"));
    plot.series.push_back(change(levels, "contact_area", "contact area"));
  }
  return plot;
}

/// Returns the longest distance that an obstacle has moved.
double longest_way(const Json& instant) {
  double way = 0;
  for (const Json& obstacle : instant.at("obstacles")) way = std::max(way, norm_of(obstacle.at("translation")));
  return way;
}

/// Returns a plot of one number of each instant over another.
template <class X, class Y>
Plot over_instants(const Json& history, Plot plot, std::string label, const X& x, const Y& y) {
  plot.series.push_back({.label = std::move(label), .x = {}, .y = {}});
  for (const Json& instant : history) {
    plot.series.back().x.push_back(x(instant));
    plot.series.back().y.push_back(y(instant));
  }
  return plot;
}

/// Returns a function that takes the number of this name from an instant.
auto number_of(const char* name) {
  return [name](const Json& instant) { return value_of(instant.at(name)); };
}

Plot contact_history(const Json& history) {
  return over_instants(
      history, {.title = "Contact area in steps", .x = {"time [steps]", false}, .y = {"contact area [m^2]", false}},
      "contact area", number_of("time"), number_of("contact_area"));
}

/// Whether the loads follow a displacement in the end.
bool has_control(const Json& history) {
  return !history.empty() && !history.back().value("controlled_displacement", Json(nullptr)).is_null();
}

/// Returns the factor of the loads over the displacement that they follow.
Plot load_history(const Json& history) {
  return over_instants(history,
                       {.title = "Loads over the displacement that they follow",
                        .x = {"displacement [m]", false},
                        .y = {"factor of the loads", false}},
                       "loads", number_of("controlled_displacement"), number_of("load_factor"));
}

/// Returns the force of the supports over the largest displacement.
Plot support_history(const Json& history) {
  return over_instants(history,
                       {.title = "Force of the supports on the shell",
                        .x = {"largest displacement [m]", false},
                        .y = {"force [N]", false}},
                       "supports", number_of("max_displacement"),
                       [](const Json& instant) { return norm_of(instant.at("support_force")); });
}

/// Returns the force of each obstacle over the longest distance that an obstacle has moved; over the time if none has.
Plot obstacle_history(const Json& history) {
  const bool over_time = std::ranges::none_of(history, [](const Json& instant) { return longest_way(instant) > 0; });
  Plot plot;
  plot.title = "Forces of the obstacles on the shell";
  plot.x.label = over_time ? "time [steps]" : "displacement of the obstacle [m]";
  plot.y.label = "force [N]";
  for (const Json& instant : history) {
    const Json& obstacles = instant.at("obstacles");
    plot.series.resize(obstacles.size());
    for (std::size_t k = 0; k < obstacles.size(); ++k) {
      plot.series[k].label = obstacles[k].at("name").get<std::string>();
      plot.series[k].x.push_back(over_time ? value_of(instant.at("time")) : longest_way(instant));
      plot.series[k].y.push_back(norm_of(obstacles[k].at("reaction").at("force")));
    }
  }
  return plot;
}

/// Whether the supports carry a force that is more than rounding, beside the energy over the displacement.
bool has_support_force(const Json& history) {
  constexpr double rounding = 1e-9;
  return std::ranges::any_of(history, [](const Json& instant) {
    const double work = norm_of(instant.at("support_force")) * value_of(instant.at("max_displacement"));
    return work > rounding * std::abs(value_of(instant.at("energy")));
  });
}

void add_history_plots(const Json& history, bool has_obstacle, std::vector<NamedPlot>& plots) {
  if (history.empty()) return;
  if (has_control(history)) plots.push_back({"plot-history-loads", load_history(history)});
  if (has_obstacle) {
    plots.push_back({"plot-history-obstacles", obstacle_history(history)});
    plots.push_back({"plot-history-contact-area", contact_history(history)});
  }
  if (has_support_force(history)) plots.push_back({"plot-history-supports", support_history(history)});
}

}  // namespace

Json parts_to_plot(std::istream& results) {
  constexpr std::array kept{"levels",
                            "contact",
                            "files",
                            "unknowns",
                            "energy",
                            "reaction",
                            "contact_area",
                            "active",
                            "time",
                            "max_displacement",
                            "support_force",
                            "obstacles",
                            "name",
                            "translation",
                            "force",
                            "unit_names",
                            "length",
                            "load_factor",
                            "controlled_displacement"};
  constexpr int deepest = 8;
  return Json::parse(results, [&](int depth, Json::parse_event_t event, const Json& value) {
    if (depth > deepest) return false;
    if (event != Json::parse_event_t::key) return true;
    const auto& key = value.get_ref<const std::string&>();
    return std::ranges::find(kept, key) != kept.end() || (key == "history" && depth == 1);
  });
}

Plot history_plot(const Json& history) {
  return has_control(history) ? load_history(history) : obstacle_history(history);
}

Plot renamed(Plot plot, const problem::UnitNames& units) {
  plot.x.label = units.renamed(plot.x.label);
  plot.y.label = units.renamed(plot.y.label);
  return plot;
}

problem::UnitNames unit_names(const Json& results) {
  problem::UnitNames units;
  if (!results.contains("unit_names")) return units;
  const Json& names = results["unit_names"];
  units.length = names.value("length", units.length);
  units.force = names.value("force", units.force);
  return units;
}

namespace {

/// Returns the meshes of the last instant: numbers of others are those of other loads.
Json meshes_of_last(const Json& levels) {
  const auto time_of = [](const Json& level) { return level.value("time", 0.0); };
  Json last = Json::array();
  for (const Json& level : levels)
    if (time_of(level) == time_of(levels.back())) last.push_back(level);
  return last;
}

std::vector<NamedPlot> plots_in_si(const Json& results) {
  std::vector<NamedPlot> plots;
  const Json levels = meshes_of_last(results.at("levels"));
  add_history_plots(results.at("history"), !results.at("contact").is_null(), plots);
  if (levels.size() < 2) return plots;
  const bool has_contact =
      std::ranges::any_of(levels, [](const Json& level) { return value_of(level.at("active")) > 0; });
  plots.push_back({"plot-energy", over_meshes(levels, "energy", "Energy by mesh", "stored energy [J]")});
  if (has_contact) {
    plots.push_back(
        {"plot-reaction", over_meshes(levels, "reaction", "Reaction by mesh", "|force of the obstacles| [N]")});
    plots.push_back(
        {"plot-contact-area", over_meshes(levels, "contact_area", "Contact area by mesh", "contact area [m^2]")});
    plots.push_back({"plot-touching-nodes", over_meshes(levels, "active", "Touching nodes by mesh", "nodes")});
    plots.back().plot.series.front().label = "touching nodes";
    plots.back().plot.y.is_log = true;
  }
  if (levels.size() > 2) plots.push_back({"plot-changes", change_to_finest(levels, has_contact)});
  return plots;
}

}  // namespace

std::vector<NamedPlot> result_plots(const Json& results) {
  std::vector<NamedPlot> plots = plots_in_si(results);
  for (NamedPlot& named : plots) named.plot = renamed(std::move(named.plot), unit_names(results));
  return plots;
}

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
    refuse(name, row, fmt::format("\"{}\" is not a number", cell));
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

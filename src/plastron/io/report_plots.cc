#include <plastron/io/report_plots.hpp>

#include <plastron/io/history.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::io {

namespace {

using computation::Level;

/// A quantity of each mesh over the unknowns.
template <class Value>
study::Plot over_meshes(const computation::Result& result, std::string title, std::string label, std::string series,
                        Value value) {
  study::Plot plot{.title = std::move(title), .x = {"unknowns", true}, .y = {std::move(label), false}};
  plot.series.push_back({.label = std::move(series), .x = {}, .y = {}});
  for (const Level& level : result.levels) {
    plot.series.back().x.push_back(static_cast<double>(level.unknowns));
    plot.series.back().y.push_back(static_cast<double>(value(level)));
  }
  return plot;
}

/// Distance from the finest mesh's value, over that; the finest itself has none.
template <class Value>
study::Series change(const computation::Result& result, std::string label, Value value) {
  study::Series series{.label = std::move(label), .x = {}, .y = {}};
  const double finest = value(result.levels.back());
  for (std::size_t i = 0; i + 1 < result.levels.size(); ++i) {
    series.x.push_back(static_cast<double>(result.levels[i].unknowns));
    series.y.push_back(std::abs(value(result.levels[i]) / finest - 1));
  }
  return series;
}

study::Plot change_to_finest(const computation::Result& result, bool has_contact) {
  study::Plot plot{.title = "Change to the finest mesh", .x = {"unknowns", true}, .y = {"|value / finest - 1|", true}};
  plot.series.push_back(change(result, "energy", [](const Level& l) { return l.energy; }));
  if (has_contact) {
    plot.series.push_back(change(result, "reaction", [](const Level& l) { return l.reaction; }));
    plot.series.push_back(change(result, "contact area", [](const Level& l) { return l.contact_area; }));
  }
  return plot;
}

study::Plot contact_history(const computation::Result& result) {
  study::Plot plot{.title = "Contact area in steps", .x = {"time [steps]", false}, .y = {"contact area [m^2]", false}};
  plot.series.push_back({.label = "contact area", .x = {}, .y = {}});
  for (const computation::HistoryEntry& entry : result.history) {
    plot.series.back().x.push_back(entry.time);
    plot.series.back().y.push_back(entry.summary.contact_area);
  }
  return plot;
}

}  // namespace

std::vector<study::Plot> report_plots(const computation::Result& result) {
  std::vector<study::Plot> plots;
  const bool has_contact = std::ranges::any_of(result.levels, [](const Level& l) { return l.active > 0; });
  if (!result.history.empty() && result.has_obstacle) {
    plots.push_back(history_plot(result));
    plots.push_back(contact_history(result));
  }
  if (result.levels.size() < 2) return plots;
  plots.push_back(
      over_meshes(result, "Energy by mesh", "stored energy [J]", "energy", [](const Level& l) { return l.energy; }));
  if (has_contact) {
    plots.push_back(over_meshes(result, "Reaction by mesh", "|force of the obstacles| [N]", "reaction",
                                [](const Level& l) { return l.reaction; }));
    plots.push_back(over_meshes(result, "Contact area by mesh", "contact area [m^2]", "contact area",
                                [](const Level& l) { return l.contact_area; }));
    plots.push_back(over_meshes(result, "Touching nodes by mesh", "nodes", "touching nodes",
                                [](const Level& l) { return l.active; }));
    plots.back().y.is_log = true;
  }
  if (result.levels.size() > 2) plots.push_back(change_to_finest(result, has_contact));
  return plots;
}

}  // namespace plastron::io

#include <plastron/report/report.hpp>

#include <plastron/estimation/goal_record.hpp>
#include <plastron/io/result_plots.hpp>
#include <plastron/report/report_html.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plastron::report {

namespace {

/// Adds components of a vector under a path as cells.
void add_vector(const Json& results, const std::string& path, double scale, std::vector<std::string>& cells) {
  for (int d = 0; d < 3; ++d) {
    const std::string place = fmt::format("{}/{}", path, d);
    cells.push_back(html_number(at_path(results, place), place, scale));
  }
}

double largest_component(const Json& vector) {
  double largest = 0;
  for (const Json& value : vector)
    if (value.is_number()) largest = std::max(largest, std::abs(value.get<double>()));
  return largest;
}

/// Path of the forces and moments of one row of the balance in results.json.
struct Carrier {
  std::string name, path;
};

std::vector<Carrier> carriers(const Json& results) {
  std::vector<Carrier> all{{"loads", "loads"}};
  const Json &supports = at_path(results, "supports"), &bodies = at_path(results, "rigid_bodies");
  if (supports.size() + bodies.size() > 1 && at_path(results, "point_supports").empty()) {
    for (std::size_t k = 0; k < supports.size(); ++k)
      all.push_back({"supports: " + plain_words(supports[k]["boundary"]), fmt::format("supports/{}/reaction", k)});
    const Json& corners = at_path(results, "corner_supports");
    for (std::size_t k = 0; k < corners.size(); ++k)
      all.push_back(
          {"corner of " + plain_words(corners[k]["boundaries"]), fmt::format("corner_supports/{}/reaction", k)});
    for (std::size_t k = 0; k < bodies.size(); ++k)
      all.push_back({"fixed: " + plain_words(bodies[k]["name"]), fmt::format("rigid_bodies/{}/reaction", k)});
  } else {
    all.push_back({"supports", "support_reaction"});
  }
  for (const std::string list : {"foundations", "springs"})
    for (std::size_t k = 0; k < at_path(results, list).size(); ++k)
      all.push_back({plain_words(at_path(results, list)[k]["name"]), fmt::format("{}/{}/reaction", list, k)});
  const Json& obstacles = at_path(results, "obstacles");
  for (std::size_t k = 0; k < obstacles.size(); ++k)
    all.push_back({plain_words(obstacles[k]["name"]), fmt::format("obstacles/{}/reaction", k)});
  return all;
}

double component(const Json& results, const std::string& path) {
  const Json& value = at_path(results, path);
  return value.is_number() ? value.get<double>() : std::nan("");
}

/// Returns the product of two numbers of results.json; 0 if one of them is not known.
double product_of(const Json& a, const Json& b) {
  return a.is_number() && b.is_number() ? a.get<double>() * b.get<double>() : 0;
}

/// Returns the largest component of all carriers.
double scale_of(const Json& results, const std::vector<Carrier>& all, const char* what) {
  double scale = 0;
  for (const Carrier& carrier : all) scale = std::max(scale, largest_component(at_path(results, carrier.path + what)));
  return scale;
}

std::string tile(std::string_view label, const std::string& value, std::string_view unit) {
  return fmt::format(
      "<div class=\"tile\"><div class=\"label\">{}</div><div class=\"value\">{} <span "
      "class=\"unit\">{}</span></div></div>\n",
      html_text(label), value, unit == "1" ? "" : html_text(unit));
}

/// A column of a table: a label and the place in each record.
struct Column {
  std::string_view label, path;
};

/// Returns a row for each record of the list under `path`.
std::string records_html(const Json& results, std::string_view path, std::initializer_list<std::string_view> labels,
                         const std::vector<std::string>& places) {
  HtmlTable table(labels);
  const Json& list = at_path(results, path);
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::vector<std::string> cells;
    for (const std::string& place : places) {
      const std::string full = fmt::format("{}/{}/{}", path, i, place);
      cells.push_back(place.empty() ? std::to_string(i) : html_number(at_path(results, full), full));
    }
    table.row(cells);
  }
  return table.text();
}

/// Returns a limit such as "at most 1e-6" as a sign and a number.
std::string limit_html(const Json& limit, const std::string& path) {
  const bool is_least = limit.contains("at_least");
  const std::string_view key = is_least ? "at_least" : "at_most";
  return fmt::format("{} {}", is_least ? "&ge;" : "&le;",
                     html_number(limit[std::string(key)], fmt::format("{}/{}", path, key)));
}

}  // namespace

namespace {

/// Returns a text on the validity of the model itself.
std::string linearity_html(const Json& results) {
  const auto value = [&](const std::string& path) { return html_number(at_path(results, path), path); };
  const std::string status = plain_words(at_path(results, "linearity/status"));
  std::string text;
  if (at_path(results, "rotations") == Json("finite"))
    text = "Rotations are finite. The margin of stability is " + value("stability/margin") +
           ": 1 without stresses, 0 where the shell snaps. ";
  else if (status == "solved")
    text = "Finite rotations change the numbers of the linear model by up to " + value("linearity/difference") + ". ";
  else if (status == "unstable")
    text = "With finite rotations the shell is not stable near this solution. ";
  else if (status == "no_solution")
    text = "With finite rotations there is no solution near this one. ";
  else if (status == "unknown")
    text = "The comparison with finite rotations failed. ";
  else
    text = "The linear model was not compared with finite rotations. ";
  return text + "The largest strain is " + value("linearity/max_strain") + ".";
}

}  // namespace

std::string verdict_html(const Json& results) {
  const std::string status = plain_words(at_path(results, "status"));
  const Json& limits = at_path(results, "certificate_limits");
  const auto kept = std::ranges::count_if(limits, [](const Json& limit) { return limit["holds"] == Json(true); });
  const bool is_good = status == "solved" && kept == static_cast<std::ptrdiff_t>(limits.size());
  return fmt::format(
      "<div class=\"verdict {}\" role=\"status\"><span class=\"sign\" aria-hidden=\"true\">{}</span><div><strong "
      "data-path=\"status\">{}</strong> {}<br>\n"
      "<a href=\"#certificate\">Certificate</a>: {} of {} rows are within their limits. {}</div></div>\n",
      is_good ? "good" : "bad", is_good ? "&#10003;" : "!", html_text(status),
      html_text(plain_words(at_path(results, "status_text"))), kept, limits.size(), linearity_html(results));
}

std::string warnings_html(const Json& results) {
  std::string list;
  for (const Json& warning : at_path(results, "warnings")) list += "<li>" + html_text(plain_words(warning)) + "</li>\n";
  return list.empty() ? "" : "<ul class=\"warnings\">\n" + list + "</ul>\n";
}

std::string key_numbers_html(const Json& results) {
  constexpr int tile_digits = 4;
  static constexpr std::array columns{Column{"stored energy", "energy"},
                                      Column{"work of the loads", "load_work"},
                                      Column{"largest displacement", "size/max_displacement"},
                                      Column{"in thicknesses", "size/max_relative_displacement"},
                                      Column{"largest rotation", "size/max_rotation"},
                                      Column{"largest von Mises stress", "stress/max_von_mises"},
                                      Column{"estimate of its error", "stress/error"},
                                      Column{"contact area", "contact/area"},
                                      Column{"touching nodes", "contact/nodes"},
                                      Column{"largest pressure", "contact/max_pressure"},
                                      Column{"largest line force at an edge", "contact/edge/max_line_reaction"},
                                      Column{"penetration between nodes", "contact/max_penetration_between_nodes"}};
  std::string tiles;
  for (const auto& [label, path] : columns) {
    const Json& value = at_path(results, path);
    const Json& units = at_path(results, "units");
    const bool has_meaning =
        path != "contact/edge/max_line_reaction" || at_path(results, "contact/edge/is_line") == Json(true);
    if (!value.is_null() && has_meaning)
      tiles += tile(label, html_number(value, path, 0, tile_digits), units.value(std::string(path), "1"));
  }
  const Json& levels = at_path(results, "levels");
  if (!levels.empty()) {
    const std::string path = fmt::format("levels/{}/unknowns", levels.size() - 1);
    tiles += tile("unknowns", html_number(at_path(results, path), path), "1");
  }
  const Json& place = at_path(results, "stress/position");
  const std::string peak =
      place.is_null()
          ? ""
          : fmt::format(
                "<p class=\"note\">The von Mises stress is largest at {} m, {} m from the mid-surface "
                "along a<sub>3</sub>.</p>\n",
                html_text(plain_words(place)), html_number(at_path(results, "stress/height"), "stress/height"));
  return "<div class=\"tiles\">\n" + tiles + "</div>\n" + peak;
}

std::string model_html(const Json& results) {
  if (at_path(results, "linearity/quantities").empty()) return "";
  return records_html(results, "linearity/quantities",
                      {"<number", "linear model", "finite rotations", "<unit", "relative difference"},
                      {"name", "linear", "finite", "unit", "difference"});
}

std::string modes_html(const Json& results) {
  if (at_path(results, "modes").empty()) return "";
  return records_html(results, "modes", {"<mode", "load factor", "frequency [Hz]"},
                      {"name", "load_factor", "frequency"}) +
         "<p>The touching nodes are held on their obstacles. All shapes are fields of <a "
         "href=\"solution.vtu\">solution.vtu</a>, the view shows the first ones.</p>\n";
}

std::string estimates_html(const Json& results) {
  const Json& goals = at_path(results, "estimates/goals");
  const bool has_mesh =
      std::any_of(goals.begin(), goals.end(), [](const Json& goal) { return goal["geometry_error"].is_number(); });
  std::vector<std::string_view> head{"<number", "value", "<unit", "estimated error", "relative", "asked for", "<"};
  if (has_mesh) head.insert(head.begin() + 5, "by the mesh of the file");
  HtmlTable table(head);
  const bool is_solved = at_path(results, "status") == Json("solved");
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const std::string path = fmt::format("estimates/goals/{}/", k);
    const Json &value = goals[k]["value"], &error = goals[k]["error"], &tolerance = goals[k]["tolerance"],
               &scale = goals[k]["scale"];
    const bool is_known = value.is_number() && error.is_number() && scale.is_number();
    // Without any force the value and its error are 0.
    const double relative = !is_known                  ? std::nan("")
                            : error.get<double>() == 0 ? 0
                                                       : error.get<double>() / scale.get<double>();
    // By the rule of the accuracy loop. A solved case has the accuracy.
    const bool is_asked = tolerance.is_number();
    const bool is_missed = is_asked && !is_solved &&
                           !(is_known && estimation::GoalRecord{.error = error.get<double>(),
                                                                .tolerance = tolerance.get<double>(),
                                                                .scale = scale.get<double>(),
                                                                .has_estimate = goals[k]["has_dual"] == Json(true)}
                                             .is_met());
    const double size = is_known ? scale.get<double>() : 0;
    std::vector<std::string> row{html_text(plain_words(goals[k]["name"])), html_number(value, path + "value", size),
                                 html_text(plain_words(goals[k]["unit"])), html_number(error, path + "error"),
                                 html_number(io::number(relative))};
    if (has_mesh) row.push_back(html_number(goals[k]["geometry_error"], path + "geometry_error"));
    row.push_back(tolerance.is_null() ? "" : html_number(tolerance, path + "tolerance"));
    row.emplace_back(is_missed ? "<strong>missed</strong>" : is_asked ? "&#10003; reached" : "");
    table.row(row, is_missed ? "missed" : "");
  }
  return goals.empty() ? "" : table.text();
}

std::string balance_html(const Json& results) {
  const auto all = carriers(results);
  HtmlTable table({"<", "force X [N]", "Y", "Z", "moment X [N m]", "Y", "Z"});
  std::vector<std::string> sums{"sum"};
  // If the forces cancel, as round a ring on a shaft, the contact pressures give the scale of rounding. If symmetry leaves no moment at
  // all, the forces times the largest displacement do.
  const auto scale = [&](const char* what) {
    const Json& lever = at_path(results, "size/max_displacement");
    const double force = std::max(scale_of(results, all, "/force"), product_of(at_path(results, "contact/max_pressure"),
                                                                               at_path(results, "contact/area")));
    if (std::string_view(what) == "/force") return force;
    return std::max(lever.is_number() ? force * lever.get<double>() : 0, scale_of(results, all, what));
  };
  for (const Carrier& carrier : all) {
    std::vector<std::string> cells{html_text(carrier.name)};
    for (const char* what : {"/force", "/moment"}) add_vector(results, carrier.path + what, scale(what), cells);
    table.row(cells);
  }
  for (const char* what : {"/force", "/moment"})
    for (int d = 0; d < 3; ++d) {
      double sum = 0;
      for (const Carrier& carrier : all) sum += component(results, fmt::format("{}{}/{}", carrier.path, what, d));
      sums.push_back(html_number(io::number(sum), "", scale(what)));
    }
  table.row(sums, "sum");
  return table.text() +
         fmt::format(
             "<p class=\"note\">Forces and moments on the shell; moments about {} m. Muted numbers are rounding errors "
             "compared with the largest of their kind. On curved shells the sum of moments falls with the mesh size."
             "</p>\n",
             html_text(plain_words(at_path(results, "moment_point"))));
}

std::string contact_html(const Json& results) {
  HtmlTable table({"<obstacle", "zone", "nodes", "area [m^2]", "force X [N]", "Y", "Z", "centre of pressure X [m]", "Y",
                   "Z", "peak pressure [Pa]", "boundary [m]"});
  const Json& obstacles = at_path(results, "obstacles");
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const std::string name = html_text(plain_words(obstacles[k]["name"]));
    const std::size_t zones = obstacles[k]["zones"].size();
    if (zones == 0) table.row({name, "no contact"});
    for (std::size_t z = 0; z < zones; ++z) {
      const std::string path = fmt::format("obstacles/{}/zones/{}/", k, z);
      const auto cell = [&](std::string_view what) {
        return html_number(at_path(results, path + std::string(what)), path + std::string(what));
      };
      std::vector<std::string> cells{name, std::to_string(z), cell("nodes"), cell("area")};
      const double pressed = product_of(at_path(results, path + "peak/pressure"), at_path(results, path + "area"));
      for (const auto& [vector, least] : {std::pair("reaction/force", pressed), std::pair("centre_of_pressure", 0.0)})
        add_vector(results, path + vector, std::max(least, largest_component(at_path(results, path + vector))), cells);
      cells.push_back(cell("peak/pressure"));
      cells.push_back(cell("boundary/length"));
      table.row(cells);
    }
  }
  return obstacles.empty() ? "" : table.text();
}

std::string probes_html(const Json& results) {
  const Json& probes = at_path(results, "probes");
  if (probes.empty()) return "";
  HtmlTable motions({"<probe", "u X [m]", "Y", "Z", "r X [rad]", "Y", "Z", "gap [m]", "pressure [Pa]"});
  HtmlTable resultants({"<probe", "N 11 [N/m]", "22", "12", "M 11 [N]", "22", "12", "Q 1 [N/m]", "2"});
  HtmlTable stresses({"<probe", "<place", "stress 11 [Pa]", "22", "12", "von Mises [Pa]"});
  for (const auto& [name, probe] : probes.items()) {
    const std::string label = html_text(name);
    const auto add = [&values = probe](std::vector<std::string>& cells, const std::string& key, std::size_t size) {
      const Json& vector = at_path(values, key);
      for (std::size_t c = 0; c < size; ++c)
        cells.push_back(html_number(vector.is_array() ? vector[c] : Json(nullptr), "", largest_component(vector)));
    };
    std::vector<std::string> motion{label}, resultant{label};
    for (const char* key : {"u", "r"}) add(motion, key, 3);
    for (const char* key : {"gap", "eta"}) motion.push_back(html_number(at_path(probe, key)));
    motions.row(motion);
    for (const char* key : {"N", "M"}) add(resultant, key, 3);
    add(resultant, "Q", 2);
    resultants.row(resultant);
    for (const auto& [key, place] :
         {std::pair("lower", "lower face"), std::pair("middle", "mid-surface"), std::pair("upper", "upper face")}) {
      std::vector<std::string> stress{label, place};
      add(stress, fmt::format("stress_{}", key), 3);
      stress.push_back(html_number(at_path(probe, fmt::format("von_mises_{}", key))));
      stresses.row(stress);
    }
  }
  return motions.text() + resultants.text() + stresses.text() +
         "<p class=\"note\">Forces, moments and stresses are along t<sub>1</sub> and t<sub>2</sub>, the axes of the "
         "fields.</p>\n";
}

std::string certificate_html(const Json& results) {
  HtmlTable table({"<row", "value", "limit", "<unit", "<", "<why this limit"});
  const problem::UnitNames units = io::unit_names(results);
  for (const auto& quantity : io::certificate_quantities()) {
    const std::string row(quantity.path), path = "certificate/" + row, limit_path = "certificate_limits/" + row;
    const Json& limit = at_path(results, limit_path);
    const bool holds = !limit.is_null() && limit["holds"] == Json(true);
    const std::string meaning = html_text(quantity.meaning),
                      unit = quantity.unit == "1" ? "" : html_text(units.label(quantity.unit));
    const std::string name = fmt::format("<abbr title=\"{}\">{}</abbr>", meaning, html_text(row));
    const std::string value = html_number(at_path(results, path), path);
    if (limit.is_null())
      table.row({name, value, "", unit, "", meaning});
    else
      table.row(
          {name, value, limit_html(limit, limit_path), unit,
           holds ? "&#10003; holds" : "<strong>&#10007; missed</strong>", html_text(plain_words(limit["reason"]))},
          holds ? "" : "missed");
  }
  return table.text() +
         "<p class=\"note\">Recomputed from displacements alone, without the solver. <code>plastron verify</code> "
         "repeats this from the files.</p>\n";
}

/// The names of the columns are short: a page of 1000 pixels shows the whole table.
std::string levels_html(const Json& results) {
  if (at_path(results, "levels").empty()) return "";
  return records_html(results, "levels",
                      {"mesh", "cells", "unknowns", "steps", "energy [J]", "reaction [N]", "touching", "area [m^2]",
                       "least gap [m]", "time [s]"},
                      {"", "cells", "unknowns", "iterations", "energy", "reaction", "active", "contact_area", "min_gap",
                       "seconds/total"});
}

std::string history_html(const Json& results) {
  if (at_path(results, "history").empty()) return "";
  return records_html(results, "history",
                      {"<step", "time", "unknowns", "load factor", "energy [J]", "largest |u| [m]",
                       "contact area [m^2]", "largest pressure [Pa]", "<status"},
                      {"step", "time", "unknowns", "load_factor", "energy", "max_displacement", "contact_area",
                       "max_pressure", "status"});
}

std::string files_html(const Json& results) {
  std::string list;
  for (const Json& file : at_path(results, "files")) {
    const std::string name = html_text(plain_words(file));
    list += fmt::format("<a href=\"{0}\">{0}</a> ", name);
  }
  return "<p class=\"files\"><a href=\"results.json\">results.json</a> " + list + "</p>\n";
}

}  // namespace plastron::report

#include <plastron/report/report.hpp>

#include <plastron/report/report_html.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

namespace plastron::report {

namespace {

std::string term(std::string_view name, const std::string& html) {
  return html.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_text(name), html);
}

/// Whether a value needs no text: zero in any form, null, or no entries.
bool says_nothing(const Json& value) {
  if (value.is_number()) return value.get<double>() == 0;
  if (value.is_array() && !value.empty()) {
    for (const Json& entry : value)
      if (!says_nothing(entry)) return false;
    return true;
  }
  return value.is_null() || value.empty() || value == Json(false);
}

/// Returns "force (0, 0, -0.002), region shell": entries in the order of the settings, except those in `without`.
std::string described(const Json& table, std::initializer_list<std::string_view> without = {}) {
  std::string text;
  for (const auto& [key, value] : table.items()) {
    if (std::ranges::find(without, key) != without.end() || says_nothing(value)) continue;
    std::string name = key;
    std::ranges::replace(name, '_', ' ');
    text += (text.empty() ? "" : ", ") + name + " " + plain_words(value);
  }
  return text;
}

std::string joined(const Json& list) {
  if (!list.is_array()) return plain_words(list);
  std::string text;
  for (const Json& entry : list) text += (text.empty() ? "" : ", ") + plain_words(entry);
  return text;
}

/// Returns a paragraph for each table of a list.
template <class Words>
std::string each(const Json& list, Words&& words) {
  std::string html;
  if (list.is_array())
    for (const Json& entry : list) html += "<div>" + html_text(words(entry)) + "</div>";
  return html;
}

std::string support_words(const Json& support) {
  const Json& boundary = at_path(support, "boundary");
  const std::string where = boundary.is_null() ? "point " + plain_words(at_path(support, "point")) : joined(boundary);
  const std::string values = described(at_path(support, "values"));
  return where + ": " + joined(at_path(support, "fix")) + " fixed" + (values.empty() ? "" : " at " + values);
}

std::string load_words(const Json& load) {
  const Json& boundary = at_path(load, "boundary");
  const Json& region = at_path(load, "region");
  std::string where = "on the surface";
  if (!boundary.is_null()) where = "on boundary " + joined(boundary);
  if (!region.is_null()) where = "on region " + joined(region);
  std::string text = described(load, {"boundary", "region"});
  const auto is_zero = [&](const char* key) { return says_nothing(at_path(load, key)); };
  if (is_zero("force") && is_zero("pressure") && is_zero("couple")) text += text.empty() ? "force 0" : ", force 0";
  return text + " " + where;
}

/// Describes an obstacle. Its shape is the entry that is a table.
std::string obstacle_words(const Json& obstacle) {
  std::string shape;
  for (const auto& [key, value] : obstacle.items())
    if (value.is_object()) shape += key + " (" + described(value) + ")";
  std::ranges::replace(shape, '_', ' ');
  std::string rest;
  for (const auto& [key, value] : obstacle.items())
    if (!value.is_object() && key != "name" && !says_nothing(value)) rest += ", " + key + " " + plain_words(value);
  return plain_words(at_path(obstacle, "name")) + ": " + shape + rest;
}

std::string step_words(const Json& step) {
  std::string text = plain_words(at_path(step, "name")) + ": " + described(step, {"name", "move"});
  for (const Json& move : at_path(step, "move"))
    text += "; " + plain_words(at_path(move, "obstacle")) + " moves, " + described(move, {"obstacle"});
  return text;
}

std::string geometry_html(const Json& geometry) {
  if (!geometry.is_object()) return "";
  std::string html;
  const Json& domain = at_path(geometry, "domain");
  if (domain.is_object())
    for (const auto& [shape, values] : domain.items())
      html += "<div>domain: " + html_text(shape) +
              (values.is_object() ? " (" + html_text(described(values)) + ")" : " " + html_text(plain_words(values))) +
              "</div>";
  for (const auto& [key, value] : geometry.items())
    if (key != "domain" && !says_nothing(value))
      html += "<div>" + html_text(key) + ": <code>" + html_text(plain_words(value)) + "</code></div>";
  return html;
}

std::string mesh_words(const Json& mesh) {
  return fmt::format("{} cells of degree {}, {} refinements of the coarsest mesh", plain_words(at_path(mesh, "cells")),
                     plain_words(at_path(mesh, "degree")), plain_words(at_path(mesh, "refinements")));
}

}  // namespace

std::string case_html(const Json& settings) {
  if (!settings.is_object()) return "";
  const std::string text =
      term("mid-surface", geometry_html(at_path(settings, "geometry"))) +
      term("constants", html_text(described(at_path(settings, "constants")))) +
      term("shell", html_text(described(at_path(settings, "shell"), {"penalty", "stabilisation"}))) +
      term("regions", each(at_path(settings, "region"), [](const Json& region) { return described(region); })) +
      term("joined edges", each(at_path(settings, "join"), [](const Json& join) { return described(join); })) +
      term("rigid bodies", each(at_path(settings, "rigid_body"), [](const Json& body) { return described(body); })) +
      term("supports", each(at_path(settings, "support"), support_words)) +
      term("foundations", each(at_path(settings, "foundation"), [](const Json& one) { return described(one); })) +
      term("springs", each(at_path(settings, "spring"), [](const Json& one) { return described(one); })) +
      term("loads", each(at_path(settings, "load"), load_words)) +
      term("gravity", html_text(described(at_path(settings, "gravity")))) +
      term("obstacles", each(at_path(settings, "obstacle"), obstacle_words)) +
      term("steps", each(at_path(settings, "step"), step_words)) +
      term("mesh", settings.contains("mesh") ? html_text(mesh_words(settings["mesh"])) : "");
  return text.empty() ? "" : "<dl class=\"case\">\n" + text + "</dl>\n";
}

}  // namespace plastron::report

// Reads [[probe]] and [[line]]: the places where results are requested.
#include <plastron/config/limits.hpp>
#include <plastron/config/sections.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plastron::config {

namespace {

/// Whether a name can be the name of a file, because lines are written to files.
bool is_file_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
    return (c < 128 && std::isalnum(c) != 0) || c == '-' || c == '_';
  });
}

/// Returns equidistant points along a polyline, including its ends.
std::vector<Eigen::Vector2d> along(const std::vector<Eigen::Vector2d>& corners, std::size_t count) {
  std::vector<double> reached{0};
  for (std::size_t i = 1; i < corners.size(); ++i)
    reached.push_back(reached.back() + (corners[i] - corners[i - 1]).norm());
  std::vector<Eigen::Vector2d> points;
  std::size_t piece = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = reached.back() * static_cast<double>(i) / static_cast<double>(count - 1);
    while (piece + 1 < corners.size() && reached[piece] < s) ++piece;
    const double t = (s - reached[piece - 1]) / (reached[piece] - reached[piece - 1]);
    points.push_back(corners[piece - 1] + std::min(t, 1.0) * (corners[piece] - corners[piece - 1]));
  }
  return points;
}

std::vector<Eigen::Vector2d> on_arc(Table& arc, std::size_t count) {
  const Eigen::Vector2d centre = arc.point("centre").value_or(Eigen::Vector2d::Zero());
  const double radius = arc.number("radius").value_or(1), degree = std::numbers::pi / 180;
  const double from = arc.number("from").value_or(0) * degree, to = arc.number("to").value_or(360) * degree;
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
    points.push_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

std::vector<Eigen::Vector2d> read_points(Table& table, const std::optional<fem::Domain>& domain) {
  const auto count = static_cast<std::size_t>(std::max(table.integer("points").value_or(101), 2));
  if (table.has("through") == table.has("arc")) {
    const std::string what = "a line goes either through points or along an arc";
    if (table.has("arc"))
      table.report("arc", what, "through or arc", "remove one of them");
    else
      table.reading().report(table.place(), what, "through or arc", "write through = [[0, 0], [1, 0]]");
    return {};
  }
  if (table.has("arc")) {
    auto arc = table.table("arc");
    if (!arc) return {};
    auto points = on_arc(*arc, count);
    table.effective["arc"] = arc->effective;
    return points;
  }
  const auto corners = table.points("through");
  if (!corners) return {};
  for (std::size_t i = 0; i + 1 < corners->size(); ++i)
    if ((*corners)[i] == (*corners)[i + 1]) {
      table.report("through", fmt::format("points {} and {} are the same", i + 1, i + 2));
      return {};
    }
  if (corners->size() < 2) {
    table.report("through", "one point makes no line", "two points or more",
                 "name the place of a single point in a [[probe]]");
    return {};
  }
  for (const Eigen::Vector2d& at : *corners)
    if (domain && !may_contain(*domain, at))
      table.report("through", fmt::format("the point [{}, {}] is outside the domain", at[0], at[1]));
  return along(*corners, count);
}

}  // namespace

void read_probes(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem) {
  auto& effective = root.effective["probe"] = nlohmann::json::array();
  for (Table& table : root.tables("probe")) {
    const auto name = table.text("name");
    const auto at = table.point("at");
    if (name && name->empty()) table.report("name", "a probe needs a name");
    if (name && std::ranges::count(problem.probes, *name, &problem::Probe::name) > 0)
      table.report("name", fmt::format("two probes are named \"{}\"", *name), "", "choose another name");
    if (at && domain && !may_contain(*domain, *at))
      table.report("at", fmt::format("the probe at [{}, {}] is outside the domain", (*at)[0], (*at)[1]));
    problem.probes.push_back({name.value_or(""), at.value_or(Eigen::Vector2d::Zero())});
    effective.push_back(table.effective);
  }
}

void read_lines(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem) {
  auto& effective = root.effective["line"] = nlohmann::json::array();
  for (Table& table : root.tables("line")) {
    const auto name = table.text("name");
    if (name && !is_file_name(*name))
      table.report("name", "the name of a line is part of a file's name", "letters, digits, - and _",
                   "choose such a name");
    if (name && std::ranges::count(problem.lines, *name, &problem::Line::name) > 0)
      table.report("name", fmt::format("two lines are named \"{}\"", *name), "", "choose another name");
    problem.lines.push_back({name.value_or(""), read_points(table, domain)});
    effective.push_back(table.effective);
  }
}

}  // namespace plastron::config

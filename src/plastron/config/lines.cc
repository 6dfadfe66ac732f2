// Reads [[probe]] and [[line]]: the places where results are requested.
#include <plastron/config/sections.hpp>

#include <cmath>
#include <numbers>

namespace plastron::config {

namespace {

/// Returns equidistant points along a polyline, including its ends.
std::vector<ShellPlace> along(const std::vector<ShellPlace>& corners, std::size_t count) {
  std::vector<double> reached{0};
  for (std::size_t i = 1; i < corners.size(); ++i)
    reached.push_back(reached.back() + (corners[i] - corners[i - 1]).norm());
  std::vector<ShellPlace> points;
  std::size_t piece = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = reached.back() * static_cast<double>(i) / static_cast<double>(count - 1);
    while (piece + 1 < corners.size() && reached[piece] < s) ++piece;
    const double t = (s - reached[piece - 1]) / (reached[piece] - reached[piece - 1]);
    points.emplace_back(corners[piece - 1] + std::min(t, 1.0) * (corners[piece] - corners[piece - 1]));
  }
  return points;
}

/// An arc in the parameter plane, with angles in degrees.
struct Arc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 1, from = 0, to = 360;
};

std::vector<ShellPlace> on_arc(const Arc& arc, std::size_t count) {
  const double degree = std::numbers::pi / 180, from = arc.from * degree, to = arc.to * degree;
  std::vector<ShellPlace> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1);
    points.emplace_back(arc.centre + arc.radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return points;
}

std::vector<ShellPlace> read_points(Table& table) {
  const auto count = static_cast<std::size_t>(std::max(table.integer("points").value_or(101), 2));
  if (table.has("through") == table.has("arc")) {
    const std::string what = "a line goes either through points or along an arc";
    if (table.has("arc"))
      table.report("arc", what, "through or arc", "remove one of them");
    else
      table.report_here(what, "through or arc", "write through = [[0, 0], [1, 0]]");
    return {};
  }
  if (table.has("arc")) {
    if (table.reading().has_mesh_in_space()) {
      table.report("arc", "an arc lies in the plane of x and y, which a mesh in space does not have", "through",
                   "write through = [[X, Y, Z], ...]");
      return {};
    }
    Arc arc;
    table.in_table("arc", [&](Table& keys) { keys.fill(arc); });
    return on_arc(arc, count);
  }
  const auto corners = table.places("through");
  if (!corners) return {};
  if (std::ranges::any_of(*corners, [&](const ShellPlace& at) { return at.size() != corners->front().size(); })) {
    table.report("through", "the points are partly [x, y] and partly [X, Y, Z]", "all of one kind");
    return {};
  }
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
  for (const ShellPlace& at : *corners) check_inside(table, "through", "the point", at);
  return along(*corners, count);
}

Section probe_section() {
  return {"probe",
          "[[probe]]",
          "A point where displacements, stress resultants and gap are reported.",
          {key("name", Kind::name, {.required = true, .example = "\"centre\""}, "a name that no other probe has"),
           key("at", Kind::place, {.required = true, .example = "[0, 0]"},
               "a point [x, y] of the domain, or [X, Y, Z] in space: the nearest point of the shell")}};
}

Section line_section() {
  return {
      "line",
      "[[line]]",
      "Points of the domain where every field is written to line-NAME.csv, one row for each point.",
      {key("name", Kind::name, {.required = true, .example = "\"meridian\""},
           "a name that no other line has, of letters, digits, - and _"),
       key("through", Kind::places, {},
           "two or more points that straight pieces connect; points in space stand for the nearest ones of the shell"),
       key("arc", Kind::table, {}, "an arc of a circle, instead of through"),
       key("points", Kind::integer, {.fallback = "101", .range = Range::between(2, 10000)},
           "number of points, equidistant in the domain, including the ends")}};
}

Section arc_section() {
  return {"line.arc",
          "arc",
          "An arc in the parameter plane.",
          {key("centre", &Arc::centre, {.fallback = "[0, 0]"}, "its centre"),
           key("radius", &Arc::radius, {.required = true, .range = Range::positive(), .example = "0.5"}, "its radius"),
           key("from", &Arc::from, {.unit = "degrees", .fallback = "0"}, "angle from the x axis where the arc begins"),
           key("to", &Arc::to, {.unit = "degrees", .fallback = "360"}, "angle from the x axis where the arc ends")}};
}

}  // namespace

void check_file_name(const Table& table, const std::string& name, const char* what) {
  const auto may_stand = [](unsigned char c) { return (c < 128 && std::isalnum(c) != 0) || c == '-' || c == '_'; };
  if (name.empty() || !std::ranges::all_of(name, may_stand))
    table.report("name", fmt::format("the name of {} is part of a file's name", what), "letters, digits, - and _",
                 "choose such a name");
}

std::vector<Section> probe_sections() { return {probe_section(), line_section(), arc_section()}; }

void read_probes(Table& root, problem::Problem& problem) {
  root.in_tables("probe", [&](Table& table) {
    const auto name = table.text("name");
    if (name && name->empty()) table.report("name", "a probe needs a name");
    if (name && std::ranges::count(problem.probes, *name, &problem::Probe::name) > 0)
      table.report("name", fmt::format("two probes are named \"{}\"", *name), "", "choose another name");
    problem::Probe probe{.name = name.value_or("")};
    const auto at = table.place("at");
    if (at && is_in_space(*at))
      probe.in_space = at->head<3>();
    else if (at)
      probe.at = at->head<2>();
    if (at) check_inside(table, "at", "the probe at", *at);
    problem.probes.push_back(std::move(probe));
  });
}

void read_lines(Table& root, problem::Problem& problem) {
  root.in_tables("line", [&](Table& table) {
    const auto name = table.text("name");
    if (name) check_file_name(table, *name, "a line");
    if (name && std::ranges::count(problem.lines, *name, &problem::Line::name) > 0)
      table.report("name", fmt::format("two lines are named \"{}\"", *name), "", "choose another name");
    problem::Line line{.name = name.value_or("")};
    for (const ShellPlace& point : read_points(table))
      if (is_in_space(point))
        line.in_space.emplace_back(point.head<3>());
      else
        line.points.emplace_back(point.head<2>());
    problem.lines.push_back(std::move(line));
  });
}

}  // namespace plastron::config

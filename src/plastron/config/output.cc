// Reads [output] and [units].
#include <plastron/config/sections.hpp>

#include <cmath>

namespace plastron::config {

namespace {

using problem::Output, problem::UnitNames;

std::optional<Eigen::Vector3d> read_axis(Table& output, const std::string& name) {
  auto axis = output.vector(name);
  if (!axis || axis->norm() > 0) return axis;
  output.report(name, "this vector has no direction", "a vector other than [0, 0, 0]",
                "write the direction that t1 shall follow");
  return {};
}

std::optional<std::vector<double>> read_heights(Table& output, const std::string& name) {
  constexpr std::size_t most = 50;
  auto heights = output.numbers(name);
  if (!heights) return {};
  if (heights->size() > most)
    output.report(name, fmt::format("{} heights are too many", heights->size()), fmt::format("at most {}", most),
                  "write solid = true for stresses all through the thickness");
  for (const double height : *heights)
    if (!(std::abs(height) <= 0.5))
      output.report(name, fmt::format("the height {:g} lies outside of the shell", height), "-0.5 <= height <= 0.5",
                    "write heights as parts of the thickness: -0.5 is the lower face, 0.5 the upper one");
  for (double& height : *heights) height += 0.0;  // no -0 in names of fields
  std::ranges::sort(*heights);
  heights->erase(std::unique(heights->begin(), heights->end()), heights->end());
  return heights;
}

std::optional<std::string> read_unit(Table& units, const std::string& name) {
  const bool is_length = name == "length";
  auto given = units.text(name);
  if (!given) return {};
  const bool is_word = !given->empty() && given->size() <= 8 && std::ranges::all_of(*given, [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
  });
  if (is_word && *given != "J" && *given != "Pa" && *given != "rad" && *given != (is_length ? "N" : "m")) return given;
  units.report(name, fmt::format("\"{}\" is no name of a unit of {}", *given, name),
               "one to eight letters, and not the name of another unit",
               std::string("write what the unit is called, such as ") + (is_length ? "\"mm\"" : "\"kN\""));
  return {};
}

Section output_section() {
  return {
      "output",
      "[output]",
      "Form of the results.",
      {key("axis", &Output::axis, read_axis, {.kind = Kind::vector, .unit = "1"},
           "direction of t1, the first axis of N, M, Q and stresses; it is projected on the surface. If not given, and "
           "where it is normal to the surface, t1 is the tangent d phi/dx"),
       key("resultants", &Output::smooth, {{"smooth", true}, {"by-cell", false}}, {.fallback = "\"smooth\""},
           "N, M, Q and stresses. smooth: recovered over the cells around each vertex; by-cell: of each cell alone, as "
           "the elements have them"),
       key("moment_point", &Output::moment_point, {.unit = "m", .fallback = "[0, 0, 0]"},
           "reference point of the moments of loads, reactions and supports"),
       key("heights", &Output::heights, read_heights, {.kind = Kind::numbers, .unit = "1", .fallback = "[]"},
           "heights z / e over the mid-surface, from -0.5 to 0.5. line-NAME.csv and the .vtu files have stresses "
           "there, in addition to both faces and the middle"),
       key("solid", Kind::boolean, {.fallback = "false"},
           "write solid.vtu: the deformed shell with its thickness, and the stresses inside it"),
       key("layers", Kind::integer, {.fallback = "4", .range = Range::between(1, 20)},
           "number of layers of cells through the thickness in solid.vtu"),
       key("precision", &Output::double_precision, {{"single", false}, {"double", true}}, {.fallback = "\"single\""},
           "precision of the numbers in solution.vtu and solid.vtu; double takes twice the space"),
       key("report", Kind::boolean, {.fallback = "true"},
           "write report.html, a page with tables, plots and the shell in three dimensions; --no-report turns it off, "
           "too")}};
}

Section units_section() {
  return {"units",
          "[units]",
          "Names of the units of the case. Numbers do not change: any consistent units are possible. Without this "
          "section texts and files use m, N, J and Pa.",
          {key("length", &UnitNames::length, read_unit, {.kind = Kind::name, .fallback = "\"m\""},
               "name of the unit of length, such as mm"),
           key("force", &UnitNames::force, read_unit, {.kind = Kind::name, .fallback = "\"N\""},
               "name of the unit of force, such as kN. The unit of E is then force / length^2: MPa for N and mm")}};
}

}  // namespace

std::vector<Section> output_sections() { return {output_section(), units_section()}; }

bool read_output(Table& root, problem::Problem& problem) {
  bool wants_report = true;
  root.in_table("output", [&](Table& output) {
    output.fill(problem.output);
    const bool is_solid = output.boolean("solid").value_or(false);
    const int layers = output.integer("layers").value_or(1);
    problem.output.solid_layers = is_solid ? layers : 0;
    wants_report = output.boolean("report").value_or(true);
  });
  return wants_report;
}

void read_units(Table& root, problem::Problem& problem) {
  root.in_table("units", [&](Table& units) { units.fill(problem.output.units); });
  problem.output.units.are_stated = root.has("units");
}

}  // namespace plastron::config

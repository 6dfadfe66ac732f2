// Reads [[load]] and [[temperature]].
#include <plastron/config/sections.hpp>
#include <plastron/geometry/pieces.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <regex>

namespace plastron::config {

int factor_of(const std::string& name, problem::Problem& problem) {
  auto& names = problem.factor_names;
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) names.push_back(name);
  return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

int read_factor_name(Table& table, problem::Problem& problem) {
  if (!table.has("name")) return -1;
  const auto name = table.text("name");
  if (!name) return -1;
  if (!name->empty()) return factor_of(*name, problem);
  table.report("name", "the name is empty", "", "leave the key out or give a name");
  return -1;
}

namespace {

energy::VectorExpression vector_or_zero(Table& load, const char* name) {
  if (load.has(name)) return load.field_vector(name).value_or(energy::VectorExpression{});
  load.effective[name] = {0.0, 0.0, 0.0};
  return {};
}

/// Returns the regions that a load or a temperature names; empty: everywhere.
std::vector<std::string> regions_of(Table& table) {
  if (!table.has("region")) return {};
  return table.name_list("region", "region", table.reading().regions()).value_or(std::vector<std::string>{});
}

/// Returns the condition of the places where a load acts.
geometry::Expression read_where(Table& load) {
  geometry::Expression everywhere(1.0);
  if (!load.has("where")) return everywhere;
  const auto where = load.field("where");
  const char* example = "write for example where = \"(X - 20)^2 + Y^2 < 9 && Z > 0\"";
  if (where && !geometry::is_piecewise(*where))
    load.report_key("where", "where is no condition", "comparisons of X, Y, Z and x, y", example);
  else if (where && std::regex_search(where->text(), std::regex("[<>]=?[^&|()?:,<>]*[<>]")))
    load.report_key("where", "comparisons do not chain", "", "write 0 < X && X < 1 in the place of 0 < X < 1");
  return where.value_or(everywhere);
}

/// Returns the point of a load in space.
std::optional<Eigen::Vector3d> read_point(Table& load, const problem::Problem& problem) {
  const auto point = load.place("point");
  if (!point || !check_inside(load, "point", "the point", *point)) return {};
  if (is_in_space(*point)) return Eigen::Vector3d(*point);
  if (problem.charts.size() == 1) return problem.charts.begin()->second((*point)[0], (*point)[1]).value;
  if (!problem.charts.empty())
    load.report("point", "the chart has pieces, so x and y do not name a place", "three numbers [X, Y, Z]");
  return {};
}

/// Returns the places around the point of a load.
std::optional<energy::Spot> read_spot(Table& load, const problem::Problem& problem) {
  if (!load.has("point")) {
    if (load.has("radius"))
      load.report_key("radius", "radius is that of the places around a point, and the load has none", "",
                      "add point = [X, Y, Z]");
    return {};
  }
  if (load.has("where"))
    load.report_key("where", "a load has a point or a condition, not both", "point or where", "remove one of them");
  energy::Spot spot{.point = read_point(load, problem).value_or(Eigen::Vector3d::Zero())};
  const geometry::Expression& thickness = problem.shell.sections.common.thickness;
  constexpr double least = 1e-3;
  if (load.has("radius")) {
    spot.radius = load.number("radius").value_or(1);
    if (thickness.is_constant() && spot.radius < least * thickness(0, 0))
      load.report("radius", fmt::format("the radius is below a thousandth of the thickness {:g}", thickness(0, 0)), "",
                  "a force on so small a spot says nothing about the shell; leave radius out");
  } else if (thickness.is_constant())
    load.effective["radius"] = spot.radius = thickness(0, 0);
  else
    load.report_key("point", "the thickness varies, so the load needs a radius", "",
                    "add radius = the size of the loaded spot");
  return spot;
}

/// Whether the load has a known sum. It has nothing else then.
bool read_total(Table& load, problem::Problem& problem) {
  if (!load.has("total") && !load.has("moment")) {
    for (const char* name : {"point", "radius"})
      if (load.has(name) && load.other_entries().empty())  // else total may be mistyped
        load.report_key(name, fmt::format("{} is for a load with a known sum", name), "total, moment",
                        "add total = [0, 0, -100], or choose places by where");
    return false;
  }
  for (const char* name : {"force", "pressure", "couple", "follows"})
    if (load.has(name))
      load.report_key(name, "a load with a total or a moment has no other force", "", "write two [[load]]");
  energy::TotalForce total;
  for (const auto& [name, value] : {std::pair("total", &total.force), std::pair("moment", &total.moment)})
    if (load.has(name)) *value = load.vector(name).value_or(Eigen::Vector3d::Zero());
  if (load.has("boundary")) total.boundaries = read_boundaries(load).value_or(std::vector<std::string>{});
  total.regions = regions_of(load);
  total.spot = read_spot(load, problem);
  total.where = read_where(load);
  total.factor = read_factor_name(load, problem);
  problem.shell.loads.totals.push_back(std::move(total));
  return true;
}

void read_edge_load(Table& load, problem::Problem& problem) {
  const auto boundaries = read_boundaries(load);
  if (load.has("pressure"))
    load.report_key("pressure", "a load on a boundary has no pressure", "force, couple",
                    "an edge is loaded by force = [x, y, z] per length");
  if (load.has("follows"))
    load.report_key("follows", "a load on a boundary does not follow the shell", "", "remove follows");
  const energy::EdgeLoad result{.boundary = "",
                                .force = vector_or_zero(load, "force"),
                                .couple = vector_or_zero(load, "couple"),
                                .where = read_where(load),
                                .factor = read_factor_name(load, problem)};
  for (const std::string& boundary : boundaries.value_or(std::vector<std::string>{})) {
    problem.shell.loads.on_edges.push_back(result);
    problem.shell.loads.on_edges.back().boundary = boundary;
  }
}

/// Only pressure follows, and only with finite rotations.
void check_follower(Table& load, const energy::AreaLoad& result, const problem::Problem& problem) {
  if (!result.follows) return;
  if (!load.has("pressure") || load.has("force") || load.has("couple"))
    load.report_key("follows", "a load that follows the shell is a pressure alone", "pressure",
                    "write force and couple in another [[load]]");
  if (problem.shell.rotations == element::Rotations::small)
    load.report_key("follows", "with small rotations no load follows the shell", "",
                    "write rotations = \"finite\" in [shell]");
}

void read_area_load(Table& load, problem::Problem& problem) {
  energy::AreaLoad result{.force = vector_or_zero(load, "force"), .couple = vector_or_zero(load, "couple")};
  result.factor = read_factor_name(load, problem);
  if (load.has("pressure"))
    result.pressure = load.field("pressure").value_or(geometry::Expression{});
  else
    load.effective["pressure"] = 0.0;
  result.regions = regions_of(load);
  result.where = read_where(load);
  result.follows = load.boolean("follows").value_or(false);
  check_follower(load, result, problem);
  problem.shell.loads.on_areas.push_back(std::move(result));
}

}  // namespace

std::vector<Section> load_sections() {
  return {
      {"load",
       "[[load]]",
       "A load with at least one of force, pressure and couple, or with a total or a moment. It is dead (it keeps its "
       "direction and is measured "
       "per area of the undeformed shell), unless it follows. It acts per area of the mid-surface, or per length "
       "of a boundary if one is named. Several loads add up.",
       {key("name", Kind::name, {}, "a name for step.factors; loads of the same name have the same factor"),
        key("boundary", Kind::name_or_names, {},
            "one or several boundaries of the domain; if not given, the load acts on the surface"),
        key("region", Kind::name_or_names, {},
            "one or several regions of the domain; if not given, the load acts on the whole surface. Not together "
            "with boundary"),
        key("where", Kind::field, {.example = "\"(X - 0.2)^2 + Y^2 < 0.03^2\""},
            "condition on X, Y, Z, and on x, y of a chart: the load acts where it holds. Its border is integrated "
            "exactly, "
            "also inside cells, and also if the places are smaller than a cell"),
        key("force", Kind::field_vector, {.unit = "N/m^2, N/m"}, "Cartesian force"),
        key("total", Kind::vector, {.unit = "N"},
            "sum of a force that is spread evenly over the area of the surface or of the regions, or over the "
            "length of the boundaries, where a curve of two of them counts twice. On a part of a symmetric shell, the "
            "force on this part. Beside it only moment"),
        key("moment", Kind::vector, {.unit = "N m"},
            "sum of the moment, about the centroid of the places, of forces that vary linearly over the places, as if "
            "a "
            "rigid plate were fixed there"),
        key("point", Kind::place, {.example = "[0.2, 0, 0.1]"},
            "[X, Y, Z], on the undeformed shell, or x and y of a chart: total and moment are spread over the places "
            "nearer "
            "than radius"),
        key("radius", Kind::number, {.unit = "m", .range = Range::positive()},
            "of the places around point; if not given, the thickness"),
        key("pressure", Kind::field, {.unit = "N/m^2"},
            "force along the normal a3; hydrostatic pressure is an expression of Z. Not on a boundary"),
        key("follows", Kind::boolean, {.fallback = "false"},
            "true: with finite rotations the pressure acts along the normal and on the area of the deformed shell"),
        key("couple", Kind::field_vector, {.unit = "N m/m^2, N m/m"}, "Cartesian couple, which does work on r")}}};
}

void read_loads(Table& root, problem::Problem& problem) {
  root.in_tables("load", [&](Table& load) {
    if (load.has("boundary") && load.has("region"))
      load.report_key("region", "a load acts on a boundary or on a region, not on both", "", "write two [[load]]");
    if (read_total(load, problem)) return;
    if (!load.has("force") && !load.has("pressure") && !load.has("couple") && load.other_entries().empty())
      load.report_here("[[load]] has no force, pressure, couple, total or moment", "",
                       "add for example force = [0, 0, -1]");
    if (load.has("boundary"))
      read_edge_load(load, problem);
    else
      read_area_load(load, problem);
  });
}

namespace {

using energy::CrossSection, energy::CrossSections, energy::Temperature;

/// Adds a temperature to the cross-sections of regions, or to all of them.
void heat(const Temperature& temperature, const std::vector<std::string>& regions, CrossSections& sections) {
  for (const std::string& region : regions)
    sections.regions.try_emplace(region, sections.common).first->second.temperatures.push_back(temperature);
  if (!regions.empty()) return;
  sections.common.temperatures.push_back(temperature);
  for (auto& [name, section] : sections.regions) section.temperatures.push_back(temperature);
}

bool expands(const std::vector<std::string>& regions, const CrossSections& sections) {
  const auto own = [&](const std::string& region) {
    const auto found = sections.regions.find(region);
    return (found == sections.regions.end() ? sections.common : found->second).material.expands();
  };
  if (!regions.empty()) return std::ranges::any_of(regions, own);
  return sections.common.material.expands() ||
         std::ranges::any_of(sections.regions, [](const auto& region) { return region.second.material.expands(); });
}

/// Reports an expansion that no temperature uses.
void check_expansions(Table& root) {
  const auto report = [](Table& table) {
    for (const char* name : {"expansion", "expansion1", "expansion2"})
      if (table.has(name)) {
        table.report_key(name, fmt::format("{} has no effect without a temperature", name), "",
                         "add a section [[temperature]], or remove it");
        return;
      }
  };
  root.in_table("shell", report);
  root.in_tables("region", report);
  root.in_tables("material", report);
}

}  // namespace

std::vector<Section> temperature_sections() {
  return {
      {"temperature",
       "[[temperature]]",
       "A temperature over that at which the shell has no stress: T = mean + (z / e) difference at the height z. It "
       "strains materials that have an expansion, and is a load: steps multiply it. Several temperatures add up.",
       {key("name", Kind::name, {}, "a name for step.factors"),
        key("region", Kind::name_or_names, {}, "one or several regions; if not given, the whole surface"),
        key("mean", &Temperature::mean, {.unit = "K"}, "temperature of the mid-surface"),
        key("difference", &Temperature::difference, {.unit = "K"},
            "temperature of the upper face (z = e/2) less that of the lower face")}}};
}

void read_temperatures(Table& root, problem::Problem& problem) {
  CrossSections& sections = problem.shell.sections;
  root.in_tables("temperature", [&](Table& table) {
    Temperature temperature;
    table.fill(temperature);
    temperature.factor = read_factor_name(table, problem);
    if (!table.has("mean") && !table.has("difference"))
      table.report_here("[[temperature]] has neither mean nor difference", "", "add for example mean = 50");
    const std::vector<std::string> regions = regions_of(table);
    if (root.reading().mistakes.empty() && !expands(regions, sections))
      table.report_here("[[temperature]] strains nothing: no material there has an expansion", "",
                        "add expansion = 1.2e-5 to [shell] or to the [[material]]");
    heat(temperature, regions, sections);
  });
  if (sections.are_heated()) return;
  const nlohmann::json effective = root.effective;  // the check reads tables once more
  check_expansions(root);
  root.effective = effective;
}

}  // namespace plastron::config

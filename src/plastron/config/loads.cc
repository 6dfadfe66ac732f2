// Reads [[load]].
#include <plastron/config/sections.hpp>

namespace plastron::config {

namespace {

assembly::VectorExpression vector_or_zero(Table& load, const char* name) {
  if (load.has(name)) return load.field_vector(name).value_or(assembly::VectorExpression{});
  load.effective[name] = {0.0, 0.0, 0.0};
  return {};
}

void read_edge_load(Table& load, problem::Problem& problem) {
  const auto boundaries = read_boundaries(load);
  if (load.has("pressure"))
    load.report_key("pressure", "a load on a boundary has no pressure", "force, couple",
                    "an edge is loaded by force = [x, y, z] per length");
  if (load.has("follows"))
    load.report_key("follows", "a load on a boundary does not follow the shell", "", "remove follows");
  if (load.has("region"))
    load.report_key("region", "a load acts on a boundary or on a region, not on both", "", "write two [[load]]");
  const assembly::EdgeLoad result{
      .boundary = "", .force = vector_or_zero(load, "force"), .couple = vector_or_zero(load, "couple")};
  for (const std::string& boundary : boundaries.value_or(std::vector<std::string>{})) {
    problem.shell.loads.on_edges.push_back(result);
    problem.shell.loads.on_edges.back().boundary = boundary;
  }
}

/// Only pressure follows, and only with finite rotations.
void check_follower(Table& load, const assembly::AreaLoad& result, const problem::Problem& problem) {
  if (!result.follows) return;
  if (!load.has("pressure") || load.has("force") || load.has("couple"))
    load.report_key("follows", "a load that follows the shell is a pressure alone", "pressure",
                    "write force and couple in another [[load]]");
  if (problem.shell.rotations == element::Rotations::small)
    load.report_key("follows", "with small rotations no load follows the shell", "",
                    "write rotations = \"finite\" in [shell]");
}

void read_area_load(Table& load, problem::Problem& problem) {
  assembly::AreaLoad result{.force = vector_or_zero(load, "force"), .couple = vector_or_zero(load, "couple")};
  if (load.has("pressure"))
    result.pressure = load.field("pressure").value_or(geometry::Expression{});
  else
    load.effective["pressure"] = 0.0;
  if (load.has("region"))
    result.regions = load.name_list("region", "region", load.reading().regions()).value_or(std::vector<std::string>{});
  result.follows = load.boolean("follows").value_or(false);
  check_follower(load, result, problem);
  problem.shell.loads.on_areas.push_back(std::move(result));
}

}  // namespace

std::vector<Section> load_sections() {
  return {{"load",
           "[[load]]",
           "A load with at least one of force, pressure and couple. It is dead (it keeps its direction and is measured "
           "per area of the undeformed shell), unless it follows. It acts per area of the mid-surface, or per length "
           "of a boundary if one is named. Several loads add up.",
           {key("boundary", Kind::name_or_names, {},
                "one or several boundaries of the domain; if not given, the load acts on the surface"),
            key("region", Kind::name_or_names, {},
                "one or several regions of the domain; if not given, the load acts on the whole surface. Not together "
                "with boundary"),
            key("force", Kind::field_vector, {.unit = "N/m^2, N/m"}, "Cartesian force"),
            key("pressure", Kind::field, {.unit = "N/m^2"}, "force along the normal a3; not on a boundary"),
            key("follows", Kind::boolean, {.fallback = "false"},
                "true: with finite rotations the pressure acts along the normal and on the area of the deformed shell"),
            key("couple", Kind::field_vector, {.unit = "N m/m^2, N m/m"}, "Cartesian couple, which does work on r")}}};
}

void read_loads(Table& root, problem::Problem& problem) {
  root.in_tables("load", [&](Table& load) {
    if (!load.has("force") && !load.has("pressure") && !load.has("couple"))
      load.report_here("[[load]] has neither force nor pressure nor couple", "", "add for example force = [0, 0, -1]");
    if (load.has("boundary"))
      read_edge_load(load, problem);
    else
      read_area_load(load, problem);
  });
}

}  // namespace plastron::config

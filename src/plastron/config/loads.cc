// Reads [[load]].
#include <plastron/config/sections.hpp>

namespace plastron::config {

namespace {

assembly::VectorExpression vector_or_zero(Table& load, const char* name) {
  if (load.has(name)) return load.field_vector(name).value_or(assembly::VectorExpression{});
  load.effective[name] = {0.0, 0.0, 0.0};
  return {};
}

void read_edge_load(Table& load, const std::optional<fem::Domain>& domain, problem::Problem& problem) {
  const auto boundaries = read_boundaries(load, domain);
  if (load.has("pressure"))
    load.reading().report(load.key_place("pressure"), "a load on a boundary has no pressure", "force, couple",
                          "an edge is loaded by force = [x, y, z] per length");
  if (load.has("region"))
    load.reading().report(load.key_place("region"), "a load acts on a boundary or on a region, not on both", "",
                          "write two [[load]]");
  const assembly::EdgeLoad result{
      .boundary = "", .force = vector_or_zero(load, "force"), .couple = vector_or_zero(load, "couple")};
  for (const std::string& boundary : boundaries.value_or(std::vector<std::string>{})) {
    problem.shell.loads.on_edges.push_back(result);
    problem.shell.loads.on_edges.back().boundary = boundary;
  }
}

void read_area_load(Table& load, const std::optional<fem::Domain>& domain, problem::Problem& problem) {
  assembly::AreaLoad result{.force = vector_or_zero(load, "force"), .couple = vector_or_zero(load, "couple")};
  if (load.has("pressure"))
    result.pressure = load.field("pressure").value_or(geometry::Expression{});
  else
    load.effective["pressure"] = 0.0;
  if (load.has("region")) {
    const auto known = domain ? fem::region_names(*domain) : std::vector<std::string>{};
    result.regions = load.name_list("region", "region", known).value_or(std::vector<std::string>{});
  }
  problem.shell.loads.on_areas.push_back(std::move(result));
}

}  // namespace

void read_loads(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem) {
  auto& effective = root.effective["load"] = nlohmann::json::array();
  for (Table& load : root.tables("load")) {
    if (!load.has("force") && !load.has("pressure") && !load.has("couple"))
      load.reading().report(load.place(), "[[load]] has neither force nor pressure nor couple", "",
                            "add for example force = [0, 0, -1]");
    if (load.has("boundary"))
      read_edge_load(load, domain, problem);
    else
      read_area_load(load, domain, problem);
    effective.push_back(load.effective);
  }
}

}  // namespace plastron::config

// Reads [[region]] and [gravity]: the regions' own data, and the weight of all.
#include <plastron/config/material.hpp>
#include <plastron/config/sections.hpp>

#include <algorithm>
#include <iterator>

namespace plastron::config {

namespace {

/// Reads a section of a region. Its initial values are the values of [shell].
void read_section(Table& region, assembly::CrossSection& section) {
  if (!has_elastic_constants(region) && !region.has("thickness") && !region.has("density"))
    region.reading().report(region.place(), "[[region]] has nothing of its own",
                            "thickness, E and nu, lambda and mu, density",
                            "give one of them, or leave the region out: it is like [shell] anyway");
  read_material(region, "[[region]]", section.material);
  if (region.has("thickness")) section.thickness = region.field("thickness").value_or(section.thickness);
  if (region.has("density")) section.density = region.number("density").value_or(section.density);
}

/// Returns the place of the first density in the file.
std::optional<Place> density_place(const Table& root) {
  std::vector<toml::value> tables;
  if (root.has("shell")) tables.push_back(root.value("shell").value());
  if (const toml::value regions = root.value("region").value(); regions.is_array())
    std::ranges::copy(regions.as_array(), std::back_inserter(tables));
  for (const toml::value& table : tables)
    if (table.is_table() && table.as_table().count("density") > 0)
      return root.reading().source.key("density", table.as_table().at("density"));
  return {};
}

}  // namespace

void read_regions(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem) {
  auto& effective = root.effective["region"] = nlohmann::json::array();
  const auto known = domain ? fem::region_names(*domain) : std::vector<std::string>{};
  for (Table& region : root.tables("region")) {
    const auto name = region.known_name("name", "region", known);
    assembly::CrossSection section = problem.shell.sections.common;
    read_section(region, section);
    effective.push_back(region.effective);
    if (!name) continue;
    if (!problem.shell.sections.regions.emplace(*name, std::move(section)).second)
      region.report("name", fmt::format("two [[region]] are named \"{}\"", *name), "",
                    "write all that it has in one of them");
  }
}

void read_gravity(Table& root, problem::Problem& problem) {
  const auto density = density_place(root);
  if (root.has("gravity")) {
    if (!density)
      root.reading().report(root.key_place("gravity"), "[gravity] has nothing to pull at: no density is given", "",
                            "add density = 7850 to [shell] or to a [[region]]");
    auto gravity = root.table("gravity");
    if (!gravity) return;
    if (const auto g = gravity->vector("acceleration")) problem.shell.loads.gravity = *g;
    root.effective["gravity"] = gravity->effective;
  } else if (density) {
    root.reading().report(*density, "a density is given, but nothing pulls at it", "",
                          "add a section [gravity] with acceleration = [0, 0, -9.81]");
  }
}

}  // namespace plastron::config

// The list of all sections, and the keys of the case file itself: one for each section.
#include <plastron/config/sections.hpp>

#include <algorithm>
#include <stdexcept>

namespace plastron::config {

namespace {

std::vector<Section> file_sections() {
  const auto required = [](const char* name, const char* meaning) {
    return key(name, Kind::table, {.required = true}, meaning);
  };
  const auto table = [](const char* name, const char* meaning) {
    return key(name, Kind::table, {.fallback = "{}"}, meaning);
  };
  const auto tables = [](const char* name, const char* meaning) {
    return key(name, Kind::tables, {.fallback = "[]"}, meaning);
  };
  return {{"",
           "the case file",
           "A case file is a TOML file with these sections.",
           {key("title", Kind::text, {.fallback = "\"\""}, "shown in reports"),
            key("constants", Kind::free_table, {.fallback = "{}"}, "named numbers for expressions"),
            tables("material", "materials with a name"),
            required("shell", "material and thickness"),
            required("geometry", "the mid-surface"),
            tables("imperfection", "differences of the mid-surface from its ideal shape"),
            tables("region", "thickness, material, density of a region"),
            table("accuracy", "required accuracy of results"),
            table("mesh", "the discretisation"),
            tables("boundary", "names of edges of a CAD file"),
            tables("join", "joined edges"),
            tables("rigid_body", "rigid bodies that carry edges"),
            tables("support", "prescribed displacements and rotations"),
            tables("temperature", "temperatures"),
            tables("foundation", "elastic foundations"),
            tables("spring", "springs at points and on rigid bodies"),
            tables("load", "dead loads"),
            table("gravity", "gravity, for the weight of the shell"),
            tables("obstacle", "rigid obstacles"),
            tables("step", "loads and obstacles that change in steps"),
            tables("case", "load cases"),
            tables("envelope", "least and largest numbers of load cases"),
            tables("probe", "points where results are reported"),
            tables("line", "lines along which results are tabulated"),
            table("output", "form of the results"),
            table("units", "names of the units"),
            table("contact", "the contact solver"),
            table("model", "comparison with finite rotations"),
            table("modes", "buckling loads and natural frequencies"),
            table("solver", "iteration limits and tolerances")}}};
}

}  // namespace

const std::vector<Section>& sections() {
  static const std::vector<Section> all = [] {
    std::vector<Section> list;
    for (const auto declare :
         {file_sections,       constants_sections,    material_sections,    shell_sections,      geometry_sections,
          cad_sections,        imperfection_sections, accuracy_sections,    mesh_sections,       join_sections,
          rigid_body_sections, support_sections,      temperature_sections, foundation_sections, load_sections,
          obstacle_sections,   step_sections,         probe_sections,       output_sections,     solver_sections})
      std::ranges::move(declare(), std::back_inserter(list));
    return list;
  }();
  return all;
}

const Section& section(const std::string& path) {
  const auto found = std::ranges::find(sections(), path, &Section::path);
  if (found == sections().end()) throw std::logic_error("no section is declared as " + path);
  return *found;
}

}  // namespace plastron::config

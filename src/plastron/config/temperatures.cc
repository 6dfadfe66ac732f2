// Reads [[temperature]].
#include <plastron/config/sections.hpp>

#include <algorithm>

namespace plastron::config {

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
    std::vector<std::string> regions;
    if (table.has("region"))
      regions = table.name_list("region", "region", table.reading().regions()).value_or(std::vector<std::string>{});
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

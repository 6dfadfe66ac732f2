// Reads [[join]].
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>

#include <algorithm>

namespace plastron::config {

namespace {

bool is_boundary(Table& table, const std::string& name, const std::optional<fem::Domain>& domain) {
  const auto known = domain ? fem::boundary_names(*domain) : std::vector<std::string>{};
  if (known.empty() || std::ranges::count(known, name) > 0) return true;
  table.report("boundaries", fmt::format("the domain has no boundary \"{}\"", name), joined(known),
               did_you_mean(name, known));
  return false;
}

}  // namespace

void read_joins(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem) {
  auto& effective = root.effective["join"] = nlohmann::json::array();
  for (Table& table : root.tables("join")) {
    const auto names = table.texts("boundaries");
    effective.push_back(table.effective);
    if (!names) continue;
    if (names->size() != 2) {
      table.report("boundaries", fmt::format("a join has {} boundaries", names->size()), "two");
      continue;
    }
    if ((*names)[0] == (*names)[1]) {
      table.report("boundaries", fmt::format("\"{}\" is to be joined to itself", (*names)[0]), "two boundaries");
      continue;
    }
    if (is_boundary(table, (*names)[0], domain) && is_boundary(table, (*names)[1], domain))
      problem.joins.push_back({{(*names)[0], (*names)[1]}});
  }
}

}  // namespace plastron::config

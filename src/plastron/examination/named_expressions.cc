#include <plastron/examination/checks.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace plastron::examination {

namespace {

using geometry::Expression;

bool matters(const Expression& f) { return !f.is_constant() || !std::isfinite(f(0, 0)); }

/// Returns a place in words, for example " on the boundary "left"".
std::string place_of(const NamedExpression& e) {
  if (e.point) return fmt::format(" at the point ({:.6g}, {:.6g})", (*e.point)[0], (*e.point)[1]);
  if (!e.boundary.empty()) return fmt::format(" on the boundary \"{}\"", e.boundary);
  if (e.regions.empty()) return "";
  return fmt::format(" on the region{} \"{}\"", e.regions.size() > 1 ? "s" : "", fmt::join(e.regions, "\", \""));
}

/// Adds f with a name. `where` contains neither.
void add(const std::string& name, const Expression& f, NamedExpression where, std::vector<NamedExpression>& all) {
  if (!matters(f)) return;
  where.name = fmt::format("{}{}, {},", name, place_of(where), quoted(f));
  where.f = f;
  all.push_back(std::move(where));
}

std::string component_name(const assembly::PrescribedComponent& component) {
  const auto direction = [&] {
    switch (component.direction) {
      case assembly::Direction::x:
        return "x";
      case assembly::Direction::y:
        return "y";
      case assembly::Direction::z:
        return "z";
      case assembly::Direction::conormal:
        return "n";
      case assembly::Direction::tangent:
        return "t";
      case assembly::Direction::axis_1:
        return "1";
      case assembly::Direction::axis_2:
        return "2";
      case assembly::Direction::axis_3:
        return "3";
      case assembly::Direction::given:
        return "d";
      default:
        return "a3";
    }
  };
  return fmt::format("{}.{}", component.unknown == assembly::Unknown::displacement ? "u" : "r", direction());
}

}  // namespace

std::string quoted(const Expression& f) {
  constexpr std::size_t longest = 60;
  if (f.text().size() <= longest) return fmt::format("\"{}\"", f.text());
  return fmt::format("\"{}...\"", f.text().substr(0, longest));
}

std::vector<NamedExpression> support_expressions(const problem::Problem& problem) {
  std::vector<NamedExpression> all;
  for (const assembly::Support& support : problem.shell.supports)
    for (const assembly::PrescribedComponent& component : support.components)
      add("the value of " + component_name(component), component.value,
          {.boundary = support.boundary, .point = support.point}, all);
  return all;
}

std::vector<NamedExpression> load_expressions(const problem::Problem& problem) {
  std::vector<NamedExpression> all;
  problem.shell.loads.for_each_expression(
      [&](const Expression& f, const std::string& name, const energy::LoadPlace& place) {
        add(name, f, {.boundary = place.boundary, .regions = place.regions}, all);
      });
  for (const energy::Foundation& foundation : problem.shell.foundations) {
    const std::string of =
        fmt::format(" of {} \"{}\"", foundation.is_spring() ? "spring" : "foundation", foundation.name);
    const NamedExpression where{.boundary = foundation.boundaries.empty() ? "" : foundation.boundaries.front(),
                                .regions = foundation.regions,
                                .point = foundation.point};
    for (const auto& [name, f] :
         {std::pair("the normal stiffness", &foundation.normal),
          std::pair("the tangential stiffness", &foundation.tangential),
          std::pair("the shear stiffness", &foundation.shear), std::pair("a stiffness", &foundation.stiffness[0]),
          std::pair("a stiffness", &foundation.stiffness[1]), std::pair("a stiffness", &foundation.stiffness[2])})
      add(name + of, *f, where, all);
  }
  const auto add_temperatures = [&](const energy::CrossSection& section, const std::vector<std::string>& regions) {
    for (const energy::Temperature& temperature : section.temperatures) {
      add("the mean of a temperature", temperature.mean, {.regions = regions}, all);
      add("the difference of a temperature", temperature.difference, {.regions = regions}, all);
    }
  };
  const energy::CrossSections& sections = problem.shell.sections;
  if (sections.regions.empty()) add_temperatures(sections.common, {});
  for (const auto& [region, section] : sections.regions) add_temperatures(section, {region});
  return all;
}

}  // namespace plastron::examination

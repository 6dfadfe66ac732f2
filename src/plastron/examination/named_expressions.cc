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
      [&](const Expression& f, const std::string& name, const assembly::LoadPlace& place) {
        add(name, f, {.boundary = place.boundary, .regions = place.regions}, all);
      });
  return all;
}

}  // namespace plastron::examination

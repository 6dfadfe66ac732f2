#include <plastron/examination/named_expressions.hpp>

#include <fmt/format.h>

#include <cmath>

namespace plastron::examination {

namespace {

using geometry::Expression;

bool matters(const Expression& f) { return !f.is_constant() || !std::isfinite(f(0, 0)); }

void add(const std::string& name, const Expression& f, const std::string& boundary, std::vector<NamedExpression>& all) {
  if (!matters(f)) return;
  all.push_back({boundary.empty() ? fmt::format("{}, {},", name, quoted(f))
                                  : fmt::format("{} on the boundary \"{}\", {},", name, boundary, quoted(f)),
                 f, boundary});
}

void add(const std::string& name, const assembly::VectorExpression& f, const std::string& boundary,
         std::vector<NamedExpression>& all) {
  for (std::size_t k = 0; k < 3; ++k) add(fmt::format("the {} component of {}", "xyz"[k], name), f[k], boundary, all);
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

std::vector<NamedExpression> support_expressions(const computation::Problem& problem) {
  std::vector<NamedExpression> all;
  for (const assembly::Support& support : problem.supports)
    for (const assembly::PrescribedComponent& component : support.components)
      add("the value of " + component_name(component), component.value, support.boundary, all);
  return all;
}

std::vector<NamedExpression> load_expressions(const computation::Problem& problem) {
  std::vector<NamedExpression> all;
  for (const assembly::AreaLoad& load : problem.area_loads) {
    add("a load's force", load.force, "", all);
    add("a load's pressure", load.pressure, "", all);
    add("a load's couple", load.couple, "", all);
  }
  for (const assembly::EdgeLoad& load : problem.edge_loads) {
    add("a load's force", load.force, load.boundary, all);
    add("a load's couple", load.couple, load.boundary, all);
  }
  return all;
}

}  // namespace plastron::examination
